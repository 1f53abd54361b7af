#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "macrotask/trace_record.h"

namespace bench {

// What a reader of a trace wants to see; an empty list: all.
struct TraceFilter {
  std::vector<std::uint32_t> tasks = {};
  std::vector<macrotask::TraceClass> classes = {};
  std::vector<macrotask::TraceAction> actions = {};

  bool Task(std::uint32_t task) const { return Has(tasks, task); }
  bool Action(macrotask::TraceAction action) const {
    return Has(classes, macrotask::ClassOf(action)) && Has(actions, action);
  }
  bool Record(const macrotask::TraceRecord& record) const {
    return Task(record.task) && Action(record.action);
  }

 private:
  template <typename Value>
  static bool Has(const std::vector<Value>& list, Value value) {
    return list.empty() ||
           std::find(list.begin(), list.end(), value) != list.end();
  }
};

}  // namespace bench
