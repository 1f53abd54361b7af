#include "macrotask/trace_ring.h"

#include <algorithm>
#include <cstdlib>
#include <new>

// The reader trusts record i if, after it has read it, fewer than i + capacity
// + 1 records have been begun: nobody has then started to write over it. A slot
// is stored with release and loaded with acquire so that whoever reads a part
// of a newer record also sees that this one was begun.

namespace macrotask {
namespace {

constexpr std::uint64_t kOneMore = std::uint64_t{1} << 32;
constexpr std::uint64_t kMostInARow = std::uint64_t{0xffffffff} << 32;

std::uint64_t Load(std::uint64_t& word) {
  // Acquire: partner of the release in Store(), in the header.
  return std::atomic_ref<std::uint64_t>(word).load(std::memory_order_acquire);
}

}  // namespace

TraceRing::TraceRing(std::size_t capacity)
    : mask_(capacity - 1),
      slots_(static_cast<Slot*>(std::calloc(capacity, sizeof(Slot))),
             &std::free) {
  if (slots_ == nullptr) throw std::bad_alloc();
}

void TraceRing::AppendTest(const TraceRecord& record) {
  const bool again = record.action == last_action_ &&
                     record.task == last_task_ &&
                     record.object() == static_cast<std::uint32_t>(last_data_);
  if (again) {
    if (last_data_ < kMostInARow) last_data_ += kOneMore;
    const std::uint64_t number = num_begun_.load(std::memory_order_relaxed);
    Store(slots_[(number - 1) & mask_].data, last_data_);
    return;
  }
  last_task_ = record.task;
  last_data_ = record.data;
  AppendNext(record);
}

std::vector<TraceRecord> TraceRing::Read(std::uint64_t* num_lost) const {
  const std::size_t capacity = mask_ + 1;
  const std::uint64_t end = num_written_.load(std::memory_order_acquire);
  const std::uint64_t begin = end > capacity ? end - capacity : 0;
  std::vector<TraceRecord> records;
  records.reserve(end - begin);
  for (std::uint64_t i = begin; i < end; ++i) {
    Slot& slot = slots_[i & mask_];
    const std::uint64_t rest = Load(slot.rest);
    records.push_back({Load(slot.clock), Load(slot.data),
                       static_cast<std::uint32_t>(rest >> 32),
                       static_cast<std::uint16_t>(rest >> 16),
                       static_cast<TraceAction>(rest & 0xffff)});
  }
  const std::uint64_t begun = num_begun_.load(std::memory_order_relaxed);
  const std::uint64_t first_safe = begun > capacity ? begun - capacity : 0;
  const std::uint64_t num_unsafe =
      std::min(first_safe > begin ? first_safe - begin : 0, end - begin);
  records.erase(records.begin(),
                records.begin() + static_cast<std::ptrdiff_t>(num_unsafe));
  *num_lost += begin + num_unsafe;
  return records;
}

}  // namespace macrotask
