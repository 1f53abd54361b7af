#pragma once

#include <cstdint>
#include <string_view>

namespace macrotask {

class Lock;

enum class ObjectKind { kNone, kBarrier, kEvent, kLock, kTask };

std::string_view Name(ObjectKind kind);  // "barrier", "event", ...

// Internal: a number for a new object, from 1, each kind for itself.
std::uint32_t NextNumber(ObjectKind kind);

// Internal: what a task waits for. kNone: nothing that the program knows of.
struct WaitedObject {
  ObjectKind kind = ObjectKind::kNone;
  std::uint32_t number = 0;
  const Lock* lock = nullptr;  // set iff kind is kLock
};

}  // namespace macrotask
