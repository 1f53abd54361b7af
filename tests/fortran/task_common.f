C     TASK COMMON: what a task stores there, the routines that it calls find
C     there, and no other task does. COMMON is one for all.
      PROGRAM TSKCOM
      EXTERNAL WORK
      INTEGER NTASK
      PARAMETER (NTASK = 5)
      INTEGER BAR, NSEEN(NTASK)
      COMMON /SHARED/ BAR, NSEEN
      INTEGER ME, BUFFER(20000)
      COMMON /MINE/ ME, BUFFER
C$OMP THREADPRIVATE(/MINE/)
      INTEGER TCA(2,NTASK), NUMBER(NTASK), I, ROUND

      ME = -1
      CALL BARASGN(BAR, NTASK)
C     In the second round the tasks are on pthreads that have had a task.
      DO 40 ROUND = 1, 2
         DO 10 I = 1, NTASK
            NSEEN(I) = 0
            NUMBER(I) = 10*ROUND + I
            TCA(1,I) = 2
   10       CALL TSKSTART(TCA(1,I), WORK, NUMBER(I))
         DO 20 I = 1, NTASK
   20       CALL TSKWAIT(TCA(1,I))
         DO 30 I = 1, NTASK
   30       IF (NSEEN(I) .NE. 20000) STOP 1
   40    CONTINUE
C     The initial task has its own too.
      IF (ME .NE. -1) STOP 2
      PRINT *, 'good'
      END

      SUBROUTINE WORK(NUMBER)
      INTEGER NTASK
      PARAMETER (NTASK = 5)
      INTEGER BAR, NSEEN(NTASK)
      COMMON /SHARED/ BAR, NSEEN
      INTEGER ME, BUFFER(20000)
      COMMON /MINE/ ME, BUFFER
C$OMP THREADPRIVATE(/MINE/)
      INTEGER NUMBER
      ME = NUMBER
      CALL FILL
      CALL BARSYNC(BAR)
      CALL COUNT
      END

      SUBROUTINE FILL
      INTEGER ME, BUFFER(20000), I
      COMMON /MINE/ ME, BUFFER
C$OMP THREADPRIVATE(/MINE/)
      DO 10 I = 1, 20000
   10    BUFFER(I) = 100000*ME + I
      END

      SUBROUTINE COUNT
      INTEGER NTASK
      PARAMETER (NTASK = 5)
      INTEGER BAR, NSEEN(NTASK)
      COMMON /SHARED/ BAR, NSEEN
      INTEGER ME, BUFFER(20000), I, SLOT
      COMMON /MINE/ ME, BUFFER
C$OMP THREADPRIVATE(/MINE/)
      SLOT = MOD(ME, 10)
      DO 10 I = 1, 20000
   10    IF (BUFFER(I) .EQ. 100000*ME + I) NSEEN(SLOT) = NSEEN(SLOT) + 1
      END
