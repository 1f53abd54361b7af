// macrotask/REFERENCE.md is what macrotask/cray.h and the Fortran module say, so
// that it cannot drift. After a change of these:
//
//   MACROTASK_UPDATE_REFERENCE=1 build/release/tests/qa/reference_test

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

std::string ReadFile(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(SOURCE_DIR "/") + name).rdbuf();
  return text.str();
}

// The text between /* and */, without the indentation of its lines.
std::string CommentText(std::string comment) {
  comment = std::regex_replace(comment, std::regex("\n   "), "\n");
  return comment.substr(0, comment.find_last_not_of(' ') + 1);
}

struct Routine {
  std::string section;
  std::string name;
  std::string prototype;
  std::string text;
};

struct Header {
  std::string preamble;
  std::vector<Routine> routines;
};

// What cray.h declares for handles of 64 bits: a comment, then the prototype.
Header ParseHeader(const std::string& text) {
  static const std::regex kPiece(
      R"re(/\*((?:[^*]|\*(?!/))*)\*/|(?:\n)((?:void|int|double) (\w+)\([^;]*;))re");
  static const std::regex kSection(R"(\s*---- (.*[^ -]) -+\s*)");
  Header header;
  std::string section, comment;
  for (std::sregex_iterator it(text.begin(), text.end(), kPiece), end;
       it != end; ++it) {
    std::smatch match;
    const std::string found = (*it)[1];
    if ((*it)[2].matched) {
      header.routines.push_back({section, (*it)[3], (*it)[2], comment});
      comment.clear();
    } else if (std::regex_match(found, match, kSection)) {
      section = match[1];
    } else if (section.empty() && header.preamble.empty()) {
      header.preamble = CommentText(found.substr(1));
    } else {
      comment = CommentText(found.substr(1));
    }
  }
  return header;
}

// "subroutine x(a, &\n  b)" on one line.
std::string JoinLines(const std::string& fortran) {
  return std::regex_replace(fortran, std::regex(R"(&[ ]*\n[ ]*)"), "");
}

// Names that the module declares optional in `body`.
std::set<std::string> OptionalNames(const std::string& body) {
  static const std::regex kLine("optional :: ([^\n]*)");
  static const std::regex kName("\\w+");
  std::set<std::string> names;
  for (std::sregex_iterator it(body.begin(), body.end(), kLine), end; it != end;
       ++it) {
    const std::string list = (*it)[1];
    for (std::sregex_iterator name(list.begin(), list.end(), kName);
         name != end; ++name) {
      names.insert(name->str());
    }
  }
  return names;
}

// How Fortran calls a routine; "" if the module does not have it.
std::string FortranCall(const std::string& module, const std::string& name) {
  std::string lower;
  for (const char c : name) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const std::regex procedure(
      "(subroutine|function) (?:macrotask_)?" + lower +
      R"re(\(([^)]*)\)((?:.|\n)*?)end (?:subroutine|function))re");
  std::smatch match;
  if (!std::regex_search(module, match, procedure)) return "";
  const auto optional = OptionalNames(match[3]);
  std::string arguments, brackets;
  std::istringstream list(match[2]);
  for (std::string argument; std::getline(list, argument, ',');) {
    argument = argument.substr(argument.find_first_not_of(' '));
    if (optional.contains(argument) && brackets.empty()) {
      arguments += " [";
      brackets = "]";
    }
    arguments += (arguments.empty() ? "" : ", ") + argument;
  }
  arguments += brackets;
  arguments = std::regex_replace(arguments, std::regex(R"( \[, )"), " [, ");
  if (match[1] == "function") return "result = " + name + "(" + arguments + ")";
  return "CALL " + name + (arguments.empty() ? "" : "(" + arguments + ")");
}

// The comment at the beginning of the module.
std::string FortranPreamble(const std::string& module) {
  std::istringstream lines(module);
  std::string text;
  for (std::string line; std::getline(lines, line) && line[0] == '!';) {
    text += (line.starts_with("! ") ? line.substr(2) : line.substr(1)) + "\n";
  }
  return text;
}

std::string MakeReference() {
  const Header header = ParseHeader(ReadFile("macrotask/cray.h"));
  const std::string module =
      JoinLines(ReadFile("macrotask/fortran/macrotask.f90"));
  std::string page =
      "# Reference of the Cray calls\n\n"
      "Made from [cray.h](cray.h) and [macrotask.f90](fortran/macrotask.f90) "
      "by tests/qa/reference_test.cc.\n\n```text\n" +
      header.preamble + "\n```\n\n## Fortran\n\n```text\n" +
      FortranPreamble(ReadFile("macrotask/fortran/macrotask.f90")) + "```\n";
  std::string section;
  for (const Routine& routine : header.routines) {
    if (routine.section != section) page += "\n## " + routine.section + "\n";
    section = routine.section;
    page += "\n### " + routine.name + "\n\n```text\nC        " +
            routine.prototype + "\n";
    const std::string fortran = FortranCall(module, routine.name);
    if (!fortran.empty()) page += "Fortran  " + fortran + "\n";
    if (routine.name == "LOCKASGN" || routine.name == "EVASGN") {
      page += "         only by `use macrotask`; without: CALL " +
              routine.name + "(" +
              (routine.name == "EVASGN" ? "event" : "lock") + ")\n";
    }
    page += "\n" + routine.text + "\n```\n";
  }
  return page;
}

TEST(Reference, IsWhatTheHeaderAndTheModuleSay) {
  const std::string page = MakeReference();
  if (std::getenv("MACROTASK_UPDATE_REFERENCE") != nullptr) {
    std::ofstream(SOURCE_DIR "/macrotask/REFERENCE.md") << page;
  }
  EXPECT_EQ(ReadFile("macrotask/REFERENCE.md"), page)
      << "run this test with MACROTASK_UPDATE_REFERENCE=1";
}

TEST(Reference, SaysSomethingOfEveryRoutineInBothLanguages) {
  const Header header = ParseHeader(ReadFile("macrotask/cray.h"));
  const std::string module =
      JoinLines(ReadFile("macrotask/fortran/macrotask.f90"));
  std::set<std::string> names;
  for (const Routine& routine : header.routines) {
    names.insert(routine.name);
    EXPECT_NE(routine.text, "") << routine.name;
    if (routine.name.ends_with("_IF")) continue;  // An optional argument there.
    EXPECT_NE(FortranCall(module, routine.name), "") << routine.name;
  }
  for (const char* name :
       {"TSKSTART", "TSKWAIT", "TSKTEST", "TSKVALUE", "TSKLIST",  "TSKTUNE",
        "LOCKASGN", "LOCKON",  "LOCKOFF", "LOCKTEST", "LOCKREL",  "EVASGN",
        "EVPOST",   "EVWAIT",  "EVCLEAR", "EVTEST",   "EVREL",    "BARASGN",
        "BARSYNC",  "BARREL",  "BUFTUNE", "BUFUSER",  "BUFPRINT", "BUFDUMP",
        "TSECND",   "MTTIMES"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

// Every routine with a handle is there for handles of 32 bits as well.
TEST(Header, HasBothWidthsOfHandles) {
  const std::string text = ReadFile("macrotask/cray_widths.h");
  for (const Routine& routine :
       ParseHeader(ReadFile("macrotask/cray.h")).routines) {
    if (!std::regex_search(routine.prototype, std::regex(R"(\(long\*)"))) {
      continue;
    }
    EXPECT_NE(text.find(" " + routine.name + "_32(int* "), std::string::npos)
        << routine.name;
  }
}

TEST(ParseHeader, FindsPlantedRoutines) {
  const Header header = ParseHeader(
      "/* Top.\n   More. */\n/* ---- Tasks ---- */\n\n/* Does it.\n   Well. "
      "*/\nvoid DOIT(long* a,\n          int b);\n/* Says. */\nint "
      "SAY(void);\n");
  EXPECT_EQ(header.preamble, "Top.\nMore.");
  ASSERT_EQ(header.routines.size(), 2u);
  EXPECT_EQ(header.routines[0].section, "Tasks");
  EXPECT_EQ(header.routines[0].name, "DOIT");
  EXPECT_EQ(header.routines[0].text, "Does it.\nWell.");
  EXPECT_EQ(header.routines[1].prototype, "int SAY(void);");
}

TEST(FortranCall, BracketsOptionalArguments) {
  const std::string module = JoinLines(
      "subroutine macrotask_doit(a, &\n  b, c)\n integer, optional :: b, c\n"
      "end subroutine\nlogical function say(x)\nend function\n");
  EXPECT_EQ(FortranCall(module, "DOIT"), "CALL DOIT(a [, b, c])");
  EXPECT_EQ(FortranCall(module, "SAY"), "result = SAY(x)");
  EXPECT_EQ(FortranCall(module, "OTHER"), "");
}

}  // namespace
