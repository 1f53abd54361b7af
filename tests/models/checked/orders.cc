#include "tests/models/checked/orders.h"

#include <string>
#include <string_view>
#include <vector>

namespace macrotask::checked {
namespace {

using enum std::memory_order;

rl::memory_order ToRelacy(std::memory_order order) {
  switch (order) {
    case relaxed:
      return rl::mo_relaxed;
    case consume:
      return rl::mo_consume;
    case acquire:
      return rl::mo_acquire;
    case release:
      return rl::mo_release;
    case acq_rel:
      return rl::mo_acq_rel;
    case seq_cst:
      return rl::mo_seq_cst;
  }
  return rl::mo_seq_cst;
}

std::string_view Name(std::memory_order order) {
  return rl::format(ToRelacy(order));
}

std::string_view Name(Step step) {
  static constexpr std::string_view kNames[] = {"load", "store", "change",
                                                "failure", "fence"};
  return kNames[static_cast<std::size_t>(step)];
}

bool IsSame(const Weakening& weakening, Step step,
            const std::source_location& where) {
  return weakening.step == step && weakening.where.line() == where.line() &&
         weakening.where.column() == where.column() &&
         std::string_view(weakening.where.file_name()) == where.file_name();
}

// Tells that `step` could also be done in the order `to`.
void Note(Step step, std::memory_order from, std::memory_order to,
          const std::source_location& where) {
  for (std::size_t i = 0; i < met.size; ++i) {
    if (IsSame(met.all[i], step, where) && met.all[i].to == to) return;
  }
  if (met.size == met.all.size()) RL_ASSERT(!"more orders than expected");
  met.all[met.size++] = {where, step, from, to};
}

}  // namespace

std::string ToString(const Weakening& weakening) {
  // "void macrotask::Epoch::Advance()" or "...::Sync()::<lambda()>"
  std::string function = weakening.where.function_name();
  if (const auto lambda = function.find("::<lambda"); lambda != function.npos) {
    function.resize(lambda);
  }
  function.resize(function.find('('));
  function.erase(0, function.rfind(':') + 1);
  return function + "() " + std::string(Name(weakening.step)) + " " +
         std::string(Name(weakening.from)) + " -> " +
         std::string(Name(weakening.to));
}

std::memory_order OfFailure(std::memory_order order) {
  if (order == acq_rel) return acquire;
  return order == release ? relaxed : order;
}

rl::memory_order Order(Step step, std::memory_order order,
                       const std::source_location& where) {
  const bool acquires = step != Step::kStore;
  const bool releases =
      step == Step::kStore || step == Step::kChange || step == Step::kFence;
  if (order == seq_cst) {
    Note(step, order,
         acquires && releases ? acq_rel
         : acquires           ? acquire
                              : release,
         where);
  }
  if (order == acq_rel) {
    Note(step, order, acquire, where);
    Note(step, order, release, where);
  }
  if (order == acquire || order == release) Note(step, order, relaxed, where);
  if (in_force && IsSame(*in_force, step, where)) order = in_force->to;
  return ToRelacy(order);
}

}  // namespace macrotask::checked
