! Four tasks race to assign a lock, add under it, and meet at a barrier, by the
! module.
subroutine add(number, seen, total, lock, barrier)
  use macrotask
  implicit none
  integer :: number, seen, total, lock, barrier

  call lockasgn(lock, 0)
  call lockon(lock)
  total = total + number
  call lockoff(lock)
  call barsync(barrier)
  seen = total
end subroutine

program main
  use macrotask
  implicit none
  external :: add
  integer :: tca(2, 4), number(4) = [1, 2, 3, 4], seen(4)
  integer :: total = 0, lock = 0, barrier, i

  call barasgn(barrier, size(number))
  tca(1, :) = 2
  do i = 1, size(number)
    call tskstart(tca(:, i), add, number(i), seen(i), total, lock, barrier)
  end do
  do i = 1, size(number)
    call tskwait(tca(:, i))
  end do
  if (any(seen /= 10)) stop 1
end program
