// README's commands: the two scripts are there, and every line that runs the
// program uses subcommands and options which its --help knows.

#include <gtest/gtest.h>
#include <stdio.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Words = std::vector<std::string>;
// The words of a subcommand's --help; "" is the program itself.
using Help = std::function<std::set<std::string>(const std::string&)>;

std::string ReadFile(const std::string& name) {
  std::ostringstream text;
  text << std::ifstream(std::string(SOURCE_DIR "/") + name).rdbuf();
  return text.str();
}

// Commands in the ```sh fences, as words up to a comment, pipe or redirection.
std::vector<Words> ShellCommands(const std::string& markdown) {
  static const std::regex kContinuation(R"(\\\n)");
  std::istringstream lines(std::regex_replace(markdown, kContinuation, " "));
  std::vector<Words> commands;
  bool in_shell = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) {
      in_shell = line == "```sh";
      continue;
    }
    if (!in_shell) continue;
    std::istringstream stream(line.substr(0, line.find_first_of("#|<>;&")));
    Words words;
    for (std::string word; stream >> word;) words.push_back(word);
    if (!words.empty()) commands.push_back(words);
  }
  return commands;
}

// What is wrong with a command; "" if nothing, or if it runs something else.
std::string CheckCommand(Words words, const Help& help) {
  if (words[0] == "bench/reproduce") {
    words[0] = "reproduce";
    words.insert(words.begin(), "macrotask");
  }
  if (!std::regex_match(words[0], std::regex("(.*/)?macrotask"))) return "";
  if (words[0] != "macrotask" && words[0] != README_PROGRAM) {
    return words[0] + " is not " README_PROGRAM;
  }
  std::string subcommand;
  size_t first_option = 1;
  if (words.size() > 1 && !words[1].starts_with("-")) {
    subcommand = words[1];
    first_option = 2;
    if (!help("").contains(subcommand)) return subcommand + " is not known";
  }
  for (size_t i = first_option; i < words.size(); ++i) {
    const std::string option = words[i].substr(0, words[i].find('='));
    // A negative number is an option's value.
    if (!std::regex_match(option, std::regex("--?[a-zA-Z].*"))) continue;
    if (!help(subcommand).contains(option)) return option + " is not known";
  }
  return "";
}

std::set<std::string> WordsOfHelp(const std::string& text) {
  static const std::regex kWord("[-A-Za-z0-9_]+");
  std::set<std::string> words;
  for (std::sregex_iterator it(text.begin(), text.end(), kWord), end; it != end;
       ++it) {
    words.insert(it->str());
  }
  return words;
}

std::set<std::string> ProgramHelp(const std::string& subcommand) {
  const std::string command = "'" PROGRAM "' " + subcommand + " --help";
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  char buffer[4096];
  while (pipe != nullptr && fgets(buffer, sizeof buffer, pipe) != nullptr) {
    text += buffer;
  }
  EXPECT_TRUE(pipe != nullptr && pclose(pipe) == 0) << command;
  return WordsOfHelp(text);
}

bool Names(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

TEST(Readme, NamesTheTwoScripts) {
  const std::string readme = ReadFile("README.md");
  for (const char* script : {"bench/reproduce", "tests/run"}) {
    EXPECT_TRUE(Names(readme, script)) << script;
    EXPECT_EQ(access((std::string(SOURCE_DIR "/") + script).c_str(), X_OK), 0)
        << script;
  }
}

TEST(Readme, RunsTheProgramAsItsHelpSays) {
  for (const Words& words : ShellCommands(ReadFile("README.md"))) {
    EXPECT_EQ(CheckCommand(words, ProgramHelp), "") << "in " << words[0];
  }
}

TEST(CiRun, CallsTestsRun) {
  EXPECT_EQ(access(SOURCE_DIR "/.ci/run", X_OK), 0);
  EXPECT_TRUE(Names(ReadFile(".ci/run"), "tests/run"));
}

TEST(ShellCommands, AreThoseOfTheShellFences) {
  const auto commands = ShellCommands(
      "macrotask text\n```sh\nmacrotask a \\\n  --b  # c\n\ntests/run | cat\n"
      "```\n```cc\nmacrotask d\n```\n");
  const std::vector<Words> expected = {{"macrotask", "a", "--b"},
                                       {"tests/run"}};
  EXPECT_EQ(commands, expected);
}

TEST(CheckCommand, FindsEachPlantedMistake) {
  const Help help = [](const std::string& subcommand) {
    return WordsOfHelp(subcommand.empty() ? "--version\nsimulate  runs\n"
                                          : "-s,--step FLOAT  step size\n");
  };
  const auto check = [&](const std::string& line) {
    return CheckCommand(ShellCommands("```sh\n" + line + "\n```\n")[0], help);
  };
  EXPECT_EQ(check("macrotask --version"), "");
  EXPECT_EQ(check("macrotask simulate --step=0.1"), "");
  EXPECT_EQ(check(README_PROGRAM " simulate -s 0.1 > file"), "");
  EXPECT_EQ(check("cmake --preset release"), "");
  EXPECT_NE(check("build/macrotask simulate"), "");
  EXPECT_NE(check("macrotask simulat"), "");
  EXPECT_NE(check("macrotask simulate --steps 0.1"), "");
  EXPECT_NE(check("macrotask simulate --version"), "");
  EXPECT_NE(check("macrotask --step 0.1"), "");
  EXPECT_NE(check("bench/reproduce --fast"), "");
}

}  // namespace
