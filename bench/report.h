#pragma once

#include <string>

#include "bench/reproduce.h"

// A reproduction as text: the same figures for a reader, for a spreadsheet, and
// all of them for a program.

namespace bench {

// Tables that paste as Markdown, the paper's figures beside ours.
std::string ReportText(const Reproduction& reproduction);

// Table 2, both lane widths, one row each.
std::string ReportCsv(const Reproduction& reproduction);

// Everything, with every raw figure.
std::string ReportJson(const Reproduction& reproduction);

}  // namespace bench
