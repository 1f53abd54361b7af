#include "tests/models/checked/check.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

// Relacy keeps the heap of the program under check, by inline replacements of
// operator new and delete. The one with a size it forgets; and libstdc++ sees
// them only if the compiler does not inline all there is.
void operator delete(void* memory, std::size_t) noexcept {
  ::operator delete(memory);
}
[[gnu::used]] static void* (*const relacys_new)(std::size_t) = &::operator new;
[[gnu::used]] static void (*const relacys_delete)(void*) = &::operator delete;

namespace macrotask::checked {
namespace {

// Those of the same name are numbered, from 1 in the order of the source.
std::string NameOf(const Weakening& weakening, const Weakenings& weakenings) {
  const std::string name = ToString(weakening);
  int num_of_that_name = 0, number = 1;
  for (std::size_t i = 0; i < weakenings.size; ++i) {
    const Weakening& other = weakenings.all[i];
    if (ToString(other) != name) continue;
    ++num_of_that_name;
    const auto where = std::pair(other.where.line(), other.where.column());
    if (where < std::pair(weakening.where.line(), weakening.where.column())) {
      ++number;
    }
  }
  if (num_of_that_name == 1) return name;
  return name + " (" + std::to_string(number) + ")";
}

}  // namespace

int Check(std::initializer_list<std::function<std::string()>> programs,
          const std::vector<std::string>& survivors) {
  for (const auto& program : programs) {
    const std::string failure = program();
    if (failure.empty()) continue;
    std::cout << failure << std::endl;
    return 1;
  }
  int num_wrong = 0;
  const Weakenings weakenings = met;
  for (std::size_t i = 0; i < weakenings.size; ++i) {
    in_force = weakenings.all[i];
    std::string failure;
    for (const auto& program : programs) {
      if (failure.empty()) failure = program();
    }
    const std::string name = NameOf(*in_force, weakenings);
    const bool may_survive =
        std::find(survivors.begin(), survivors.end(), name) != survivors.end();
    const bool is_wrong = failure.empty() != may_survive;
    if (is_wrong) ++num_wrong;
    std::cout << (is_wrong ? "WRONG " : "      ") << name << ": "
              << (failure.empty() ? "not found" : failure) << std::endl;
  }
  in_force.reset();
  std::cout << weakenings.size << " weakenings, " << num_wrong
            << " of them not as expected" << std::endl;
  return num_wrong == 0 ? 0 : 1;
}

}  // namespace macrotask::checked
