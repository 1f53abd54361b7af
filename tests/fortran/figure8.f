C     Figure 8, combined spatial and temporal parallelism [MSO93 section 4], as
C     a program of its time: FORTRAN 77, COMMON for what all tasks share, TASK
C     COMMON for what a task has for itself. integrators/figure8.cc has the
C     figure, and the same in C++; the test compares the two bit for bit.
C
C     The problem is that of tests/support/model_system.h.

C     Integrates NB blocks of IP points from grid point NS, with MH x IPH tasks.
C     W1, W2: weights of predictor and corrector. Y0, F0: state, and derivative
C     at the last five grid points, all chains and then the reference member.
      SUBROUTINE FIGUR8(IM, IP, MH, IPH, NB, NS, STEP, W1, W2, Y0, F0,
     &                  YEND)
      INCLUDE 'figure8.inc'
      INTEGER IM, IP, MH, IPH, NB, NS
      DOUBLE PRECISION STEP, W1(5,*), W2(5,*), Y0(*), F0(*), YEND(*)
      EXTERNAL TASK
      INTEGER TCA(2,MAXP,MAXM), NUMBER(MAXM), II, KK

      M = IM
      P = IP
      MHAT = MH
      PHAT = IPH
      NBLOCK = NB
      NSTART = NS
      H = STEP
      CALL SETUP(W1, W2, Y0, F0)

      DO 10 II = 1, PHAT
   10    CALL BARASGN(BCHAIN(II), MHAT)
      DO 20 KK = 1, MHAT
         CALL BARASGN(BPOINT(KK), PHAT)
   20    CALL EVASGN(ESHIFT(KK))

C     Arguments are passed by address: not the variables of the loops.
      DO 30 KK = 1, MAXM
   30    NUMBER(KK) = KK
      DO 40 II = 1, PHAT
      DO 40 KK = 1, MHAT
         TCA(1,II,KK) = 2
   40    CALL TSKSTART(TCA(1,II,KK), TASK, NUMBER(II), NUMBER(KK))
      DO 50 II = 1, PHAT
      DO 50 KK = 1, MHAT
   50    CALL TSKWAIT(TCA(1,II,KK))

      DO 60 II = 1, PHAT
   60    CALL BARREL(BCHAIN(II))
      DO 70 KK = 1, MHAT
         CALL BARREL(BPOINT(KK))
   70    CALL EVREL(ESHIFT(KK))
      CALL RESULT(YEND)
      END

C     Task (i,k): block points and chains in shares of one size or nearly.
      SUBROUTINE TASK(IARG, KARG)
      INCLUDE 'figure8.inc'
      INTEGER IARG, KARG, NB
      I = IARG
      K = KARG
      I1 = P*(I - 1)/PHAT + 1
      I2 = P*I/PHAT
      K1 = M*(K - 1)/MHAT + 1
      K2 = M*K/MHAT
      NEWEST = NSTART

      DO 10 NB = 1, NBLOCK
C                                               [ CS (predict) ]
         CALL CSPRED
C                                               [ OCD ]
         CALL OCD(1)
C                                               === BARSYNC(m^) ===
         CALL BARSYNC(BCHAIN(I))
C                                               [ RMA ]
         CALL RMA(1)
C                                               [ CCD ]
         CALL CCD(1)
C                                               === BARSYNC(p^) ===
         CALL BARSYNC(BPOINT(K))
C        All tasks of the chain have come from their wait for the shift.
         IF (I .EQ. 1) CALL EVCLEAR(ESHIFT(K))
C                                               [ CS (correct) ]
         CALL CSCORR
C                                               [ OCD ]
         CALL OCD(2)
C                                               === BARSYNC(m^) ===
         CALL BARSYNC(BCHAIN(I))
C                                               [ RMA ]
         CALL RMA(2)
C                                               [ CCD ]
         CALL CCD(2)
C                                               === BARSYNC(p^) ===
         CALL BARSYNC(BPOINT(K))
C                                               [shift]  EVPOST -> EVWAIT
         IF (I .EQ. 1) THEN
            CALL SHIFT
            CALL EVPOST(ESHIFT(K))
         ELSE
            CALL EVWAIT(ESHIFT(K))
         ENDIF
   10    NEWEST = NEWEST + P
      END

C     CS, predict: y(i) = y(0) + sum of w(j) f(j), j = -4 ... 0.
      SUBROUTINE CSPRED
      INCLUDE 'figure8.inc'
      INTEGER II, KK
      DO 10 II = I1, I2
         TIME(II) = (NEWEST + II)*H
         DO 20 KK = K1, K2
   20       CALL PREDIC(NY, Y(1,0,KK), F(1,-4,KK,2), II)
   10    CALL PREDIC(NZ, Z(1,0,K), G(1,-4,K,2), II)
      END

      SUBROUTINE PREDIC(N, U, D, II)
      INCLUDE 'figure8.inc'
      INTEGER N, II, J, L
      DOUBLE PRECISION U(N,0:MAXP), D(N,-4:MAXP), S
      DO 10 L = 1, N
         S = U(L,0)
         DO 20 J = -4, 0
   20       S = S + WPRED(J+5,II)*D(L,J)
   10    U(L,II) = S
      END

C     CS, correct: the same with j = p-4 ... p, predicted where j > 0.
      SUBROUTINE CSCORR
      INCLUDE 'figure8.inc'
      INTEGER II, KK
      DO 10 II = I1, I2
         DO 20 KK = K1, K2
   20       CALL CORREC(NY, Y(1,0,KK), F(1,-4,KK,1), F(1,-4,KK,2), II)
   10    CALL CORREC(NZ, Z(1,0,K), G(1,-4,K,1), G(1,-4,K,2), II)
      END

      SUBROUTINE CORREC(N, U, D1, D2, II)
      INCLUDE 'figure8.inc'
      INTEGER N, II, J, L
      DOUBLE PRECISION U(N,0:MAXP), D1(N,-4:MAXP), D2(N,-4:MAXP), S
      DO 10 L = 1, N
         S = U(L,0)
         DO 20 J = P - 4, 0
   20       S = S + WCORR(J+5-P,II)*D2(L,J)
         DO 30 J = 1, P
   30       S = S + WCORR(J+5-P,II)*D1(L,J)
   10    U(L,II) = S
      END

C     OCD: what a chain contributes to the coupling.
      SUBROUTINE OCD(IPHASE)
      INCLUDE 'figure8.inc'
      INTEGER IPHASE, II, KK
      DO 10 II = I1, I2
      DO 10 KK = K1, K2
   10    X(KK,II,IPHASE) = (1 + 0.1D0*(KK-1))*Y(1,II,KK)
      END

C     RMA, in every task: the coupling, and the reference member's derivative.
      SUBROUTINE RMA(IPHASE)
      INCLUDE 'figure8.inc'
      INTEGER IPHASE, II, KK
      DOUBLE PRECISION COUPL, S, WRONG
      DO 10 II = I1, I2
         S = 0
         DO 20 KK = 1, M
   20       S = S + X(KK,II,IPHASE)
         C(II) = S + Z(1,II,K)
         WRONG = C(II) - COUPL(TIME(II))
         G(1,II,K,IPHASE) = -Z(2,II,K) + 0.3D0*WRONG
   10    G(2,II,K,IPHASE) = Z(1,II,K) - 0.1D0*WRONG*Z(2,II,K)
      END

C     CCD: the derivatives of the chains. Every second one has a third state.
      SUBROUTINE CCD(IPHASE)
      INCLUDE 'figure8.inc'
      INTEGER IPHASE, II, KK
      DOUBLE PRECISION COUPL, WRONG, A, B
      DO 10 II = I1, I2
      DO 10 KK = K1, K2
         WRONG = C(II) - COUPL(TIME(II))
         A = Y(1,II,KK)
         B = Y(2,II,KK)
         F(1,II,KK,IPHASE) = B + 0.2D0*WRONG
         F(2,II,KK,IPHASE) = -A - 0.5D0*(A*A + B*B - 1)*B
   10    F(3,II,KK,IPHASE) = -Y(3,II,KK) + 0.1D0*WRONG
      END

C     The coupling on the solution, C(t).
      DOUBLE PRECISION FUNCTION COUPL(T)
      INCLUDE 'figure8.inc'
      INTEGER KK
      DOUBLE PRECISION T
      COUPL = COS(T)
      DO 10 KK = 1, M
   10    COUPL = COUPL + (1 + 0.1D0*(KK-1))*SIN(T + (KK-1))
      END

C     The last point of the block becomes y(0); derivatives move p places.
      SUBROUTINE SHIFT
      INCLUDE 'figure8.inc'
      INTEGER KK
      DO 10 KK = K1, K2
   10    CALL SHIFT1(NY, Y(1,0,KK), F(1,-4,KK,2))
      CALL SHIFT1(NZ, Z(1,0,K), G(1,-4,K,2))
      END

      SUBROUTINE SHIFT1(N, U, D)
      INCLUDE 'figure8.inc'
      INTEGER N, J, L
      DOUBLE PRECISION U(N,0:MAXP), D(N,-4:MAXP)
      DO 10 L = 1, N
         U(L,0) = U(L,P)
         DO 10 J = -4, 0
   10       D(L,J) = D(L,J+P)
      END

C     Weights and starting values to their places. The third state of a chain
C     that has only two is 0, and nobody asks for it.
      SUBROUTINE SETUP(W1, W2, Y0, F0)
      INCLUDE 'figure8.inc'
      DOUBLE PRECISION W1(5,*), W2(5,*), Y0(*), F0(*)
      INTEGER II, J, KK, L, N, NALL
      DO 10 II = 1, P
      DO 10 J = 1, 5
         WPRED(J,II) = H*W1(J,II)
   10    WCORR(J,II) = H*W2(J,II)

      N = 0
      NALL = 2*M + M/2 + NZ
      DO 20 KK = 1, M
         Y(3,0,KK) = 0
         DO 30 J = -4, 0
   30       F(3,J,KK,2) = 0
         DO 20 L = 1, 2 + MOD(KK+1, 2)
            N = N + 1
            Y(L,0,KK) = Y0(N)
            DO 20 J = -4, 0
   20          F(L,J,KK,2) = F0(N + (J+4)*NALL)
      DO 40 L = 1, NZ
      DO 40 KK = 1, MHAT
         Z(L,0,KK) = Y0(N+L)
         DO 40 J = -4, 0
   40       G(L,J,KK,2) = F0(N + L + (J+4)*NALL)
      END

C     The state at the end; of the reference member, the first copy.
      SUBROUTINE RESULT(YEND)
      INCLUDE 'figure8.inc'
      DOUBLE PRECISION YEND(*)
      INTEGER KK, L, N
      N = 0
      DO 10 KK = 1, M
      DO 10 L = 1, 2 + MOD(KK+1, 2)
         N = N + 1
   10    YEND(N) = Y(L,0,KK)
      DO 20 L = 1, NZ
   20    YEND(N+L) = Z(L,0,1)
      END
