#pragma once

namespace macrotask::cray {

// On stdout, flushed: TSKLIST, BUFPRINT, MTTIMES.
void PrintTaskList();
void PrintTrace();
void PrintBusyTimes();

}  // namespace macrotask::cray
