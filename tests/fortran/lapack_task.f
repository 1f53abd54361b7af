C     A routine of LAPACK is itself a task, its CHARACTER argument included: the
C     Cholesky factors of several matrices at once, some upper, some lower.
      PROGRAM LAPTSK
      EXTERNAL DPOTRF
      INTEGER N, NTASK
      PARAMETER (N = 12, NTASK = 4)
      DOUBLE PRECISION A(N,N,NTASK), X
      INTEGER TCA(2,NTASK), INFO(NTASK), I, J, K

C     A(I,J) = min(I,J), of which all elements of the factor are 1.
      DO 20 K = 1, NTASK
         DO 10 J = 1, N
         DO 10 I = 1, N
   10       A(I,J,K) = MIN(I,J)
         INFO(K) = -99
         TCA(1,K) = 2
         IF (MOD(K,2) .EQ. 0) THEN
            CALL TSKSTART(TCA(1,K), DPOTRF, 'U', N, A(1,1,K), N,
     &                    INFO(K))
         ELSE
            CALL TSKSTART(TCA(1,K), DPOTRF, 'L', N, A(1,1,K), N,
     &                    INFO(K))
         ENDIF
   20    CONTINUE
      DO 30 K = 1, NTASK
   30    CALL TSKWAIT(TCA(1,K))

      DO 40 K = 1, NTASK
         IF (INFO(K) .NE. 0) STOP 1
         DO 40 J = 1, N
         DO 40 I = J, N
            X = A(I,J,K)
            IF (MOD(K,2) .EQ. 0) X = A(J,I,K)
   40       IF (ABS(X - 1) .GT. 1D-13) STOP 2
      PRINT *, 'good'
      END
