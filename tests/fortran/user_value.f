C     TSKVALUE gives every task the third word of its task control array; 0 in
C     the initial task, and in tasks whose array has two words.
      PROGRAM USERV
      EXTERNAL LOOK
      INTEGER NTASK
      PARAMETER (NTASK = 7)
      INTEGER TCA(3,NTASK), SEEN(NTASK), I, V

      V = -1
      CALL TSKVALUE(V)
      IF (V .NE. 0) STOP 1

      DO 10 I = 1, NTASK
         TCA(1,I) = 3
         IF (I .EQ. 4) TCA(1,I) = 2
         TCA(3,I) = -100*I
         SEEN(I) = 99
   10    CALL TSKSTART(TCA(1,I), LOOK, SEEN(I))
      DO 20 I = 1, NTASK
   20    CALL TSKWAIT(TCA(1,I))

      DO 30 I = 1, NTASK
         V = -100*I
         IF (I .EQ. 4) V = 0
   30    IF (SEEN(I) .NE. V) STOP 2
      CALL TSKVALUE(V)
      IF (V .NE. 0) STOP 3
      PRINT *, 'good'
      END

      SUBROUTINE LOOK(V)
      INTEGER V
      CALL TSKVALUE(V)
      END
