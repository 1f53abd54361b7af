C     Two tasks add up, one after the other by an event, in fixed form and
C     without a declaration.
      PROGRAM MAIN
      EXTERNAL FIRST
      INTEGER TCA(2), EVENT, N
      CALL EVASGN(EVENT)
      N = 1
      TCA(1) = 2
      CALL TSKSTART(TCA, FIRST, N, EVENT)
      CALL EVWAIT(EVENT)
      N = 10*N
      CALL TSKWAIT(TCA)
      IF (N .NE. 20) STOP 1
      END

      SUBROUTINE FIRST(N, EVENT)
      INTEGER N, EVENT
      N = N + 1
      CALL EVPOST(EVENT)
      END
