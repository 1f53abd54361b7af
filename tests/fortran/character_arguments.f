C     CHARACTER arguments of different lengths reach a task, between others,
C     with the lengths that they have at the call. So do the addresses of all
C     other arguments.
      PROGRAM CHRARG
      EXTERNAL JOIN, LONE
      INTEGER TCA(2), N, M
      CHARACTER*3 SHORT
      CHARACTER*17 LONG
      CHARACTER*60 RESULT
      DOUBLE PRECISION X

      SHORT = 'abc'
      LONG = 'seventeen letters'
      N = 42
      X = 0.25D0
      TCA(1) = 2
      CALL TSKSTART(TCA, JOIN, SHORT, N, LONG, X, 'z', RESULT, M)
      CALL TSKWAIT(TCA)
      IF (RESULT .NE. 'abc|seventeen letters|z') STOP 1
      IF (M .NE. 3000000 + 17*10000 + 1*100 + 60) STOP 2
      IF (N .NE. 43) STOP 3
      IF (X .NE. 0.5D0) STOP 4

C     One argument, a part of a string.
      CALL TSKSTART(TCA, LONE, LONG(6:9))
      CALL TSKWAIT(TCA)
      IF (LONG .NE. 'seventhe  letters') STOP 5
      PRINT *, 'good'
      END

      SUBROUTINE JOIN(A, N, B, X, C, RESULT, M)
      CHARACTER*(*) A, B, C, RESULT
      INTEGER N, M
      DOUBLE PRECISION X
      RESULT = A // '|' // B // '|' // C
      M = ((LEN(A)*100 + LEN(B))*100 + LEN(C))*100 + LEN(RESULT)
      N = N + 1
      X = 2*X
      END

      SUBROUTINE LONE(S)
      CHARACTER*(*) S
      IF (LEN(S) .NE. 4) STOP 6
      S = 'the'
      END
