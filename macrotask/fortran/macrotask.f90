! The Cray macrotasking library for Fortran programs, compiled by gfortran.
!
! macrotask/cray.h says what each routine does. There are two ways to call them.
!
! As in 1993, without a declaration, in fixed or free form:
!
!       INTEGER TCA(2)
!       EXTERNAL WORK
!       TCA(1) = 2
!       CALL TSKSTART(TCA, WORK, X, N)
!       CALL TSKWAIT(TCA)
!
! or by `use macrotask`, with explicit interfaces that the compiler checks. Only
! there the arguments called optional below may be left out or given: whoever is
! called without an interface cannot see how many arguments there are. So
! without the module LOCKASGN and EVASGN take one argument, and TSECND is REAL.
!
! Two libraries: macrotask::fortran for default integers of 4 bytes, and
! macrotask::fortran_i8 for programs compiled with -fdefault-integer-8. All
! integers and handles in a call have that size, and so have LOGICAL results.
! Without the module TSECND has the size of an integer too, so programs with
! fortran_i8 that call it that way are compiled with -fdefault-real-8.
!
! What to know:
!
! - Arguments of a task are passed by address, and the task reads them while its
!   starter goes on. A loop's variable has changed by then; an element of an
!   array has not:   CALL TSKSTART(TCA(1,I), WORK, NUMBER(I))
!   Nor may it be an expression or a copy that ends with the statement.
! - The lengths of CHARACTER arguments are hidden behind all others. TSKSTART
!   without an interface hands them on. The module's TSKSTART takes arguments of
!   any type, and so cannot have their lengths: start a task that has
!   CHARACTER*(*) arguments by `external :: tskstart`, in a scope in which this
!   name does not come from the module.
! - From version 10 gfortran refuses calls of one routine, in one file, with
!   arguments of different types or number, as TSKSTART has. Old programs are compiled
!   with -std=legacy or -fallow-argument-mismatch, which make it a warning, and
!   with -w, which silences that.
! - Tasks are compiled with -frecursive (the targets add it): otherwise gfortran
!   puts large local arrays into static storage, where the tasks share them.
!   TSKTUNE('STACKSZ', words) makes room for larger ones.
! - TASK COMMON, of which every task has a copy, is this, with -fopenmp:
!
!       COMMON /BLK/ A, B
! !$OMP THREADPRIVATE(/BLK/)
!
!   wherever the block is declared. The copy is that of the pthread, which runs
!   other tasks later: at the start of a task its variables are undefined.
! - In A .OR. LOCKTEST(L) a compiler need not call the function, says Fortran.
!   Give it a statement of its own.
! - What a task prints goes through one lock of gfortran's library.
! - The user value, tca(3), holds as many characters as an integer has bytes.
module macrotask
  implicit none
  private
  public :: tskstart, tskwait, tsktest, tskvalue, tsklist, tsktune
  public :: lockasgn, lockon, lockoff, locktest, lockrel
  public :: evasgn, evpost, evwait, evclear, evtest, evrel
  public :: barasgn, barsync, barrel
  public :: buftune, bufuser, bufprint, bufdump
  public :: tsecnd, mttimes

  ! ---- Tasks ---------------------------------------------------------------

  interface
    ! Up to 20 arguments of any type, kind and rank, passed by address.
    subroutine tskstart(tca, task, a1, a2, a3, a4, a5, a6, a7, a8, a9, a10, &
                        a11, a12, a13, a14, a15, a16, a17, a18, a19, a20)
      integer :: tca(*)
      external :: task
      type(*), optional :: a1, a2, a3, a4, a5, a6, a7, a8, a9, a10
      type(*), optional :: a11, a12, a13, a14, a15, a16, a17, a18, a19, a20
      !GCC$ ATTRIBUTES NO_ARG_CHECK :: a1, a2, a3, a4, a5, a6, a7, a8, a9, a10
      !GCC$ ATTRIBUTES NO_ARG_CHECK :: a11, a12, a13, a14, a15, a16, a17, a18
      !GCC$ ATTRIBUTES NO_ARG_CHECK :: a19, a20
    end subroutine

    subroutine tskwait(tca)
      integer :: tca(*)
    end subroutine

    logical function tsktest(tca)
      integer :: tca(*)
    end function

    subroutine tskvalue(value)
      integer :: value
    end subroutine

    subroutine tsklist()
    end subroutine
  end interface

  interface tsktune
    subroutine macrotask_tsktune(keyword_1, value_1, keyword_2, value_2, &
                                 keyword_3, value_3, keyword_4, value_4, &
                                 keyword_5, value_5, keyword_6, value_6)
      character(len=*), intent(in) :: keyword_1
      integer, intent(in) :: value_1
      character(len=*), intent(in), optional :: keyword_2, keyword_3
      character(len=*), intent(in), optional :: keyword_4, keyword_5, keyword_6
      integer, intent(in), optional :: value_2, value_3
      integer, intent(in), optional :: value_4, value_5, value_6
    end subroutine
  end interface

  ! ---- Locks ---------------------------------------------------------------

  ! With `value`: only if `lock` still equals it, so that tasks may race.
  interface lockasgn
    subroutine macrotask_lockasgn(lock, value)
      integer :: lock
      integer, intent(in), optional :: value
    end subroutine
  end interface

  interface
    subroutine lockon(lock)
      integer :: lock
    end subroutine

    subroutine lockoff(lock)
      integer :: lock
    end subroutine

    logical function locktest(lock)
      integer :: lock
    end function

    subroutine lockrel(lock)
      integer :: lock
    end subroutine
  end interface

  ! ---- Events --------------------------------------------------------------

  interface evasgn
    subroutine macrotask_evasgn(event, value)
      integer :: event
      integer, intent(in), optional :: value
    end subroutine
  end interface

  interface
    subroutine evpost(event)
      integer :: event
    end subroutine

    subroutine evwait(event)
      integer :: event
    end subroutine

    subroutine evclear(event)
      integer :: event
    end subroutine

    logical function evtest(event)
      integer :: event
    end function

    subroutine evrel(event)
      integer :: event
    end subroutine
  end interface

  ! ---- Barriers ------------------------------------------------------------

  interface
    subroutine barasgn(barrier, num_tasks)
      integer :: barrier
      integer, intent(in) :: num_tasks
    end subroutine

    subroutine barsync(barrier)
      integer :: barrier
    end subroutine

    subroutine barrel(barrier)
      integer :: barrier
    end subroutine
  end interface

  ! ---- History trace -------------------------------------------------------

  interface
    subroutine buftune(keyword, value)
      character(len=*), intent(in) :: keyword, value
    end subroutine

    subroutine bufuser(action, data)
      integer, intent(in) :: action, data
    end subroutine

    subroutine bufprint()
    end subroutine

    subroutine bufdump()
    end subroutine
  end interface

  ! ---- Times ---------------------------------------------------------------

  interface tsecnd
    function macrotask_tsecnd()
      use, intrinsic :: iso_c_binding, only: c_double
      real(c_double) :: macrotask_tsecnd
    end function
  end interface

  interface
    subroutine mttimes()
    end subroutine
  end interface
end module
