#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

// Options as all subcommands have them.

namespace bench {

// What is called by its Name().
template <typename Value>
std::map<std::string, Value> ByName(std::initializer_list<Value> values) {
  std::map<std::string, Value> named;
  for (const Value value : values) named.emplace(Name(value), value);
  return named;
}

// "block, hold, spin"
template <typename Value>
std::string NamesOf(const std::map<std::string, Value>& choices) {
  std::string names;
  for (const auto& [known, value] : choices) {
    names += (names.empty() ? "" : ", ") + known;
  }
  return names;
}

// The value called `text` of the option `name`.
template <typename Value>
Value ChoiceOf(const std::string& name, const std::string& text,
               const std::map<std::string, Value>& choices) {
  const auto choice = choices.find(text);
  if (choice != choices.end()) return choice->second;
  throw std::invalid_argument("unknown " + name + " '" + text +
                              "': expected one of " + NamesOf(choices));
}

// An option whose values have names. Names only: CLI11's own transformers also
// take the numbers behind an enumeration, so that "--figure 2" would be
// Figure 3.
template <typename Value>
void AddChoice(CLI::App* app, const std::string& name, Value* value,
               const std::map<std::string, Value>& choices,
               const std::string& help) {
  app->add_option_function<std::string>(
         name,
         [=](const std::string& text) {
           *value = ChoiceOf(name, text, choices);
         },
         help)
      ->option_text("(" + NamesOf(choices) + ")");
}

// An option that may be given again and again, with one value each time: it
// leaves the words behind alone, which may be a file's name.
inline CLI::Option* AddRepeated(
    CLI::App* app, const std::string& name,
    const std::function<void(const std::string&)>& add,
    const std::string& help) {
  return app
      ->add_option_function<std::vector<std::string>>(
          name,
          [=](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) add(text);
          },
          help)
      ->allow_extra_args(false);
}

// The same, repeatable: each one adds to `values`.
template <typename Value>
void AddChoices(CLI::App* app, const std::string& name,
                std::vector<Value>* values,
                const std::map<std::string, Value>& choices,
                const std::string& help) {
  AddRepeated(
      app, name,
      [=](const std::string& text) {
        values->push_back(ChoiceOf(name, text, choices));
      },
      help)
      ->option_text("(" + NamesOf(choices) + ") ...");
}

inline CLI::Option* AddFile(CLI::App* app, const std::string& name,
                            std::string* path, const std::string& help) {
  return app->add_option(name, *path, help)->check([](const std::string& text) {
    return text.empty() ? std::string("expected the name of a file")
                        : std::string();
  });
}

}  // namespace bench
