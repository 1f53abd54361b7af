C     A task has up to 20 arguments; all of them may be CHARACTER arguments,
C     each with a length of its own.
      PROGRAM TWENTY
      EXTERNAL SUM20, LEN20
      INTEGER TCA(2), I, N, A(19), TOTAL
      CHARACTER*40 S

      DO 10 I = 1, 19
   10    A(I) = I*I
      TCA(1) = 2
      CALL TSKSTART(TCA, SUM20, A(1), A(2), A(3), A(4), A(5), A(6),
     &   A(7), A(8), A(9), A(10), A(11), A(12), A(13), A(14), A(15),
     &   A(16), A(17), A(18), A(19), TOTAL)
      CALL TSKWAIT(TCA)
C     The sum of I*I*I.
      IF (TOTAL .NE. 36100) STOP 1

      S = ' '
      N = 0
      CALL TSKSTART(TCA, LEN20, S(1:1), S(1:2), S(1:3), S(1:4), S(1:5),
     &   S(1:6), S(1:7), S(1:8), S(1:9), S(1:10), S(1:11), S(1:12),
     &   S(1:13), S(1:14), S(1:15), S(1:16), S(1:17), S(1:18), S(1:19),
     &   S(1:20))
      CALL TSKWAIT(TCA)
      IF (S .NE. '20 lengths') STOP 2
      PRINT *, 'good'
      END

      SUBROUTINE SUM20(A, B, C, D, E, F, G, H, O, P, Q, R, S, T, U, V,
     &   W, X, Y, TOTAL)
      INTEGER A, B, C, D, E, F, G, H, O, P, Q, R, S, T, U, V, W, X, Y
      INTEGER TOTAL
      TOTAL = A + 2*B + 3*C + 4*D + 5*E + 6*F + 7*G + 8*H + 9*O + 10*P
     &   + 11*Q + 12*R + 13*S + 14*T + 15*U + 16*V + 17*W + 18*X + 19*Y
      END

      SUBROUTINE LEN20(A, B, C, D, E, F, G, H, O, P, Q, R, S, T, U, V,
     &   W, X, Y, Z)
      CHARACTER*(*) A, B, C, D, E, F, G, H, O, P, Q, R, S, T, U, V,
     &   W, X, Y, Z
      INTEGER L(20), I
      L(1) = LEN(A)
      L(2) = LEN(B)
      L(3) = LEN(C)
      L(4) = LEN(D)
      L(5) = LEN(E)
      L(6) = LEN(F)
      L(7) = LEN(G)
      L(8) = LEN(H)
      L(9) = LEN(O)
      L(10) = LEN(P)
      L(11) = LEN(Q)
      L(12) = LEN(R)
      L(13) = LEN(S)
      L(14) = LEN(T)
      L(15) = LEN(U)
      L(16) = LEN(V)
      L(17) = LEN(W)
      L(18) = LEN(X)
      L(19) = LEN(Y)
      L(20) = LEN(Z)
      DO 10 I = 1, 20
   10    IF (L(I) .NE. I) STOP 3
      Z = '20 lengths'
      END
