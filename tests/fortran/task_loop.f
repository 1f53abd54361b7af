C     Tasks are started in a loop: one after the other with one task control
C     array; and at once, to meet at a barrier, take a lock and wait for an
C     event that the initial task posts.
      PROGRAM LOOPS
      EXTERNAL ADD, MEET
      LOGICAL TSKTEST, LOCKTEST, EVTEST
      INTEGER NTASK
      PARAMETER (NTASK = 6)
      INTEGER BAR, LOCK, EVENT, NPOST, NPHASE(NTASK)
      COMMON /SHARED/ BAR, LOCK, EVENT, NPOST, NPHASE
      INTEGER TCA(2), TCAS(2,NTASK), NUMBER(NTASK), I, N

      N = 0
      TCA(1) = 2
      DO 10 I = 1, 100
         NUMBER(1) = I
         CALL TSKSTART(TCA, ADD, N, NUMBER(1))
         CALL TSKWAIT(TCA)
   10    IF (TSKTEST(TCA)) STOP 1
      IF (N .NE. 5050) STOP 2

      CALL BARASGN(BAR, NTASK)
      CALL LOCKASGN(LOCK)
      CALL EVASGN(EVENT)
      NPOST = 0
      DO 20 I = 1, NTASK
         NPHASE(I) = 0
         NUMBER(I) = I
         TCAS(1,I) = 2
   20    CALL TSKSTART(TCAS(1,I), MEET, NUMBER(I))
      IF (EVTEST(EVENT)) STOP 3
      IF (.NOT. TSKTEST(TCAS(1,NTASK))) STOP 4
      CALL EVPOST(EVENT)
      IF (.NOT. EVTEST(EVENT)) STOP 5
      DO 30 I = 1, NTASK
   30    CALL TSKWAIT(TCAS(1,I))
      IF (NPOST .NE. NTASK) STOP 6

      IF (LOCKTEST(LOCK)) STOP 7
      IF (.NOT. LOCKTEST(LOCK)) STOP 8
      CALL LOCKOFF(LOCK)
      CALL LOCKREL(LOCK)
      CALL EVREL(EVENT)
      CALL BARREL(BAR)
      PRINT *, 'good'
      END

      SUBROUTINE ADD(N, I)
      INTEGER N, I
      N = N + I
      END

C     Counts phases that are separated by a barrier: nobody is ahead or behind.
      SUBROUTINE MEET(ME)
      INTEGER NTASK
      PARAMETER (NTASK = 6)
      INTEGER BAR, LOCK, EVENT, NPOST, NPHASE(NTASK)
      COMMON /SHARED/ BAR, LOCK, EVENT, NPOST, NPHASE
      INTEGER ME, I, J
      CALL EVWAIT(EVENT)
      DO 20 I = 1, 50
         NPHASE(ME) = I
         CALL BARSYNC(BAR)
         DO 10 J = 1, NTASK
   10       IF (NPHASE(J) .NE. I) STOP 9
   20    CALL BARSYNC(BAR)
      CALL LOCKON(LOCK)
      NPOST = NPOST + 1
      CALL LOCKOFF(LOCK)
      END
