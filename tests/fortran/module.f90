! The interfaces of the module: optional arguments given and left out, arguments
! of any type for TSKSTART, functions, names in lower case.
module work
  use macrotask
  implicit none
  integer, parameter :: num_tasks = 8
  integer, save :: lock = 0, event = 0, barrier = 0
  integer, save :: handles(num_tasks), counter = 0, num_set = 0

contains

  ! All race to assign the lock; one handle comes of it.
  subroutine race(me)
    integer, intent(in) :: me
    call barsync(barrier)
    call lockasgn(lock, 0)
    call evasgn(event, 0)
    call lockon(lock)
    counter = counter + 1
    handles(me) = lock
    call lockoff(lock)
    if (me == 1) call evpost(event)
    call evwait(event)
  end subroutine

  subroutine no_arguments()
    counter = counter + 1000
  end subroutine

  subroutine many(n, x, z, truth, vector, matrix, last)
    integer, intent(in) :: n
    double precision, intent(in) :: x
    complex, intent(in) :: z
    logical, intent(in) :: truth
    real, intent(in) :: vector(3), matrix(2, 2)
    double precision, intent(out) :: last
    last = n + x + real(z) + aimag(z) + sum(vector) + sum(matrix)
    if (truth) last = -last
  end subroutine

  subroutine spin()
    do while (locktest(lock))
    end do
    num_set = num_set + 1
    call lockoff(lock)
  end subroutine
end module

program module_test
  use work
  implicit none
  integer :: tca(2, num_tasks), numbers(num_tasks), i, value
  integer :: n = 3
  double precision :: x = 0.5d0, last, seconds
  complex :: z = (10., 20.)
  logical :: truth = .true.
  real :: vector(3) = 1, matrix(2, 2) = reshape([1., 2., 3., 4.], [2, 2])

  call barasgn(barrier, num_tasks)
  tca(1, :) = 2
  do i = 1, num_tasks
    numbers(i) = i
    call tskstart(tca(:, i), race, numbers(i))
  end do
  do i = 1, num_tasks
    call tskwait(tca(:, i))
    if (tsktest(tca(:, i))) stop 1
  end do
  if (counter /= num_tasks .or. any(handles /= lock)) stop 2
  if (.not. evtest(event)) stop 3

  ! Not assigned, because the variable has another value by now.
  call lockon(lock)
  call lockasgn(lock, 0)
  if (.not. locktest(lock)) stop 4
  call lockasgn(lock)  ! clears it
  if (locktest(lock)) stop 5
  call tskstart(tca(:, 1), spin)
  call lockoff(lock)
  call tskwait(tca(:, 1))
  if (num_set /= 1) stop 6
  call evasgn(event)
  if (evtest(event)) stop 7

  call tskstart(tca(:, 1), no_arguments)
  call tskwait(tca(:, 1))
  if (counter /= 1000 + num_tasks) stop 8

  call tskstart(tca(:, 1), many, n, x, z, truth, vector, matrix, last)
  call tskwait(tca(:, 1))
  if (last /= -46.5d0) stop 9

  call tskvalue(value)
  if (value /= 0) stop 10
  seconds = tsecnd()
  if (seconds < 0 .or. seconds > 1000) stop 11

  call tsktune('MAXCPU', 2)
  call tsktune('HOLDTIME', 20, 'SAMPLE', 10)
  call tsktune('MAXCPU', 2, 'DBRELEAS', 1, 'DBACTIVE', 1, 'HOLDTIME', 50, &
               'SAMPLE', 1, 'STACKSZ', 100000)
  call buftune('USERS', 'ON')
  call bufuser(65, 1234)
  call buftune('USERS', 'OFF')
  call bufprint()

  call lockrel(lock)
  call evrel(event)
  call barrel(barrier)
  print *, 'good'
end program
