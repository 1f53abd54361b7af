C     Stands in for LAPACK's routine where there is no LAPACK, and where LAPACK
C     has integers of another size: the Cholesky factor of A, upper or lower.
      SUBROUTINE DPOTRF(UPLO, N, A, LDA, INFO)
      CHARACTER*(*) UPLO
      INTEGER N, LDA, INFO, I, J, K
      DOUBLE PRECISION A(LDA,*), S
      INFO = -1
      IF (LEN(UPLO) .NE. 1) RETURN
      IF (UPLO .NE. 'U' .AND. UPLO .NE. 'L') RETURN
      DO 30 J = 1, N
      DO 30 I = J, N
         IF (UPLO .EQ. 'U') THEN
            S = A(J,I)
            DO 10 K = 1, J - 1
   10          S = S - A(K,I)*A(K,J)
         ELSE
            S = A(I,J)
            DO 20 K = 1, J - 1
   20          S = S - A(I,K)*A(J,K)
         ENDIF
         IF (I .EQ. J) THEN
            IF (S .LE. 0) THEN
               INFO = J
               RETURN
            ENDIF
            A(J,J) = SQRT(S)
         ELSEIF (UPLO .EQ. 'U') THEN
            A(J,I) = S/A(J,J)
         ELSE
            A(I,J) = S/A(J,J)
         ENDIF
   30    CONTINUE
      INFO = 0
      END
