C     Ends by the bad call that the first argument names. What was printed
C     before is not lost.
      PROGRAM BADCAL
      CHARACTER*20 WHAT
      INTEGER X, TCA(3)
      LOGICAL LOCKTEST
      EXTERNAL STUCK
      COMMON /SHARED/ X

      CALL GETARG(1, WHAT)
      X = 777
      PRINT *, 'printed before the call'
      IF (WHAT .EQ. 'lockon') CALL LOCKON(X)
      IF (WHAT .EQ. 'locktest') THEN
         CALL EVASGN(X)
         IF (LOCKTEST(X)) PRINT *, 'set'
      ENDIF
      IF (WHAT .EQ. 'evpost') THEN
         CALL EVASGN(X)
         CALL EVREL(X)
         CALL EVPOST(X)
      ENDIF
      IF (WHAT .EQ. 'barasgn') CALL BARASGN(X, 0)
      IF (WHAT .EQ. 'tskstart') THEN
         TCA(1) = 77
         CALL TSKSTART(TCA, STUCK)
      ENDIF
      IF (WHAT .EQ. 'keyword') CALL TSKTUNE('MAXCPU', 1, 'SAMPLE', 2,
     &   'DBACTIVE', 3, 'HOLDTIME', 4, 'HOLDTIMES', 5)
      IF (WHAT .EQ. 'novalue') CALL TSKTUNE('MAXCPU')
      IF (WHAT .EQ. 'value') CALL TSKTUNE('MAXCPU', -3)
      IF (WHAT .EQ. 'buftune') CALL BUFTUNE('LOCKS', 'MAYBE')
      IF (WHAT .EQ. 'bufuser') CALL BUFUSER(64, 0)
      IF (WHAT .EQ. 'deadlock') THEN
         CALL EVASGN(X)
         TCA(1) = 2
         CALL TSKSTART(TCA, STUCK)
         CALL TSKWAIT(TCA)
      ENDIF
      STOP 9
      END

      SUBROUTINE STUCK
      COMMON /SHARED/ X
      INTEGER X
      CALL EVWAIT(X)
      END
