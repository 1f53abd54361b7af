#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "macrotask/mutex.h"

namespace macrotask::cray {

// Internal: what a handle stands for. Its number is a part of the handle.
enum class HandleKind : std::uint32_t { kLock = 1, kEvent = 2, kBarrier = 3 };

// Internal: handles of 31 bits, so that they fit every client's integer and are
// never negative or 0:
//
//   bits 29-30  kind, so that an event is never taken for a lock
//   bits 16-28  generation, which tells a released handle from one in use
//   bits  0-15  index in the table of its kind
constexpr int kIndexBits = 16;
constexpr int kGenerationBits = 13;
constexpr std::uint32_t kMostIndex = (1u << kIndexBits) - 1;
constexpr std::uint32_t kMostGeneration = (1u << kGenerationBits) - 1;

constexpr std::uint32_t MakeHandle(HandleKind kind, std::uint32_t generation,
                                   std::uint32_t index) {
  return static_cast<std::uint32_t>(kind) << (kIndexBits + kGenerationBits) |
         generation << kIndexBits | index;
}
constexpr std::uint32_t IndexOf(std::uint32_t handle) {
  return handle & kMostIndex;
}
constexpr std::uint32_t GenerationOf(std::uint32_t handle) {
  return handle >> kIndexBits & kMostGeneration;
}
constexpr std::uint32_t KindOf(std::uint32_t handle) {
  return handle >> (kIndexBits + kGenerationBits);
}

// Internal: the objects of one kind behind the handles. An object is never
// destroyed, as some task may be on its way out of it: its slot is used again.
//
// Use: Find() and WasReleased() by any task at any time; the rest under the
// caller's mutex.
template <typename Object>
class HandleTable {
 public:
  explicit HandleTable(HandleKind kind) : kind_(kind) {}
  ~HandleTable() {
    for (auto& chunk : chunks_) delete chunk.load(std::memory_order_relaxed);
  }
  HandleTable(const HandleTable&) = delete;
  HandleTable& operator=(const HandleTable&) = delete;

  // The object of an assigned handle, or null. Two loads and a comparison more
  // than a pointer.
  Object* Find(std::int64_t handle) const {
    const Slot* const slot = SlotOf(handle);
    // Acquire: partner of the release in Assign().
    if (slot == nullptr ||
        slot->handle.load(std::memory_order_acquire) != handle) {
      return nullptr;
    }
    // Acquire: partner of the release in Replace().
    return slot->object.load(std::memory_order_acquire);
  }

  // A free slot's new handle; `object` belongs to it from now on. Throws
  // std::runtime_error if there is none.
  std::uint32_t Assign(Object* object) {
    const std::uint32_t index = TakeIndex();
    Slot& slot = chunks_[index / kChunk]
                     .load(std::memory_order_relaxed)
                     ->slots[index % kChunk];
    const std::uint32_t generation =
        slot.generation.load(std::memory_order_relaxed) % kMostGeneration + 1;
    slot.generation.store(generation, std::memory_order_relaxed);
    slot.object.store(object, std::memory_order_relaxed);
    const std::uint32_t handle = MakeHandle(kind_, generation, index);
    // Release: partner of the acquire in Find().
    slot.handle.store(handle, std::memory_order_release);
    return handle;
  }

  // Throws as Assign() would.
  void CheckRoom() const {
    if (!free_.empty() || num_used_ <= kMostIndex) return;
    throw std::runtime_error(std::to_string(num_used_) +
                             " are assigned already, no more are possible");
  }

  // Another object behind the same handle. Requires: Find(handle).
  void Replace(std::int64_t handle, Object* object) {
    // Release: partner of the acquire in Find().
    SlotOf(handle)->object.store(object, std::memory_order_release);
  }

  // Requires: Find(handle).
  void Release(std::int64_t handle) {
    SlotOf(handle)->handle.store(0, std::memory_order_relaxed);
    free_.push_back(IndexOf(static_cast<std::uint32_t>(handle)));
  }

  // Whether such a handle was given out once, and is not valid now.
  bool WasReleased(std::int64_t handle) const {
    const Slot* const slot = SlotOf(handle);
    return slot != nullptr && Find(handle) == nullptr &&
           slot->generation.load(std::memory_order_relaxed) >=
               GenerationOf(static_cast<std::uint32_t>(handle)) &&
           GenerationOf(static_cast<std::uint32_t>(handle)) > 0;
  }

 private:
  struct Slot {
    std::atomic<std::uint32_t> handle{0};  // 0: free
    std::atomic<std::uint32_t> generation{0};
    std::atomic<Object*> object{nullptr};
  };
  static constexpr std::uint32_t kChunk = 256;
  struct Chunk {
    Slot slots[kChunk];
  };

  // The slot that a handle of this kind names, if it was ever used; else null.
  Slot* SlotOf(std::int64_t handle) const {
    if (handle <= 0 || handle > 0x7fffffff) return nullptr;
    const auto bits = static_cast<std::uint32_t>(handle);
    if (KindOf(bits) != static_cast<std::uint32_t>(kind_)) return nullptr;
    // Acquire: partner of the release in TakeIndex().
    Chunk* const chunk =
        chunks_[IndexOf(bits) / kChunk].load(std::memory_order_acquire);
    return chunk == nullptr ? nullptr : &chunk->slots[IndexOf(bits) % kChunk];
  }

  std::uint32_t TakeIndex() {
    if (!free_.empty()) {
      const std::uint32_t index = free_.back();
      free_.pop_back();
      return index;
    }
    CheckRoom();
    if (num_used_ % kChunk == 0) {
      // Release: partner of the acquire in SlotOf().
      chunks_[num_used_ / kChunk].store(new Chunk, std::memory_order_release);
    }
    return num_used_++;
  }

  const HandleKind kind_;
  std::atomic<Chunk*> chunks_[(kMostIndex + 1) / kChunk] = {};
  std::uint32_t num_used_ = 0;
  std::vector<std::uint32_t> free_;
};

}  // namespace macrotask::cray
