#pragma once

#include <vector>

#include "macrotask/mutex.h"
#include "macrotask/task_list.h"
#include "macrotask/task_record.h"

namespace macrotask {

// Internal: held by whoever examines records, so that no two meet in one.
Mutex& ExamineMutex();

// Internal: the row of a task whose record was found in the state of `word`.
TaskStatus StatusOf(const TaskRecord& record, const TaskRecord::Word& word);

// Internal: adds what the task waits for. To be called within Examine().
void NoteWait(const WaitedObject& what, TaskStatus* status);

// Internal: the order of the list.
void SortByNumber(std::vector<TaskStatus>* tasks);

}  // namespace macrotask
