C     A large local array belongs to the task whose call it is: every element
C     still has the task's number when all tasks have written theirs.
      PROGRAM LOCALS
      EXTERNAL WORK
      INTEGER NTASK
      PARAMETER (NTASK = 4)
      INTEGER TCA(2,NTASK), NUMBER(NTASK), WRONG(NTASK), BAR, I

      CALL BARASGN(BAR, NTASK)
      DO 10 I = 1, NTASK
         NUMBER(I) = I
         TCA(1,I) = 2
   10    CALL TSKSTART(TCA(1,I), WORK, NUMBER(I), BAR, WRONG(I))
      DO 20 I = 1, NTASK
         CALL TSKWAIT(TCA(1,I))
   20    IF (WRONG(I) .NE. 0) STOP 1
      PRINT *, 'good'
      END

      SUBROUTINE WORK(NUMBER, BAR, WRONG)
      INTEGER NUMBER, BAR, WRONG, LARGE(100000), I
      DO 10 I = 1, 100000
   10    LARGE(I) = NUMBER
      CALL BARSYNC(BAR)
      WRONG = 0
      DO 20 I = 1, 100000
   20    IF (LARGE(I) .NE. NUMBER) WRONG = WRONG + 1
      END
