// How a command of `hamilcar` says what it is: its name, its options with their defaults, and the function of these that runs it.
// CLI11 reads the command line; command.cpp alone includes it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hamilcar/io/error.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hamilcar::cli {

// Bounds of a number that is typed, both allowed, and its unit for the help; neither NaN nor infinity is inside.
struct Bounds {
    double min, max;
    const char* unit = "";
};

// What a shell may offer in the place of an option's value.
using Suggestions = std::map<const CLI::Option*, std::vector<std::string>>;

class Option {
public:
    Option(CLI::Option* option, Suggestions& suggestions) : option_(option), suggestions_(&suggestions) {}
    Option& required();
    Option& needs(const Option& other);     // is of no use without it
    Option& excludes(const Option& other);  // contradicts it
    Option& one_of(std::vector<std::string> words);
    Option& suggest(std::vector<std::string> words);  // others are possible

private:
    CLI::Option* option_;
    Suggestions* suggestions_;
};

// A command as its help tells it.
struct OptionHelp {
    std::vector<std::string> names;  // "-o", "--output"; none for a word without dashes
    std::string placeholder, meaning;
    bool takes_value = false;
    std::vector<std::string> words;  // to offer; none: files
};
struct CommandHelp {
    std::string name, meaning;
    std::vector<OptionHelp> options;
};

// One command's part of the command line. Names are as CLI11 has them: "-o,--output" of an option, "vehicle" of a word without
// dashes. The help shows what stands in `value` as the default; what an optional is without it, the meaning says.
class Command {
public:
    Command(CLI::App* app, Suggestions& suggestions) : app_(app), suggestions_(&suggestions) {}
    Option add(const std::string& names, std::string& value, const std::string& meaning);
    Option add(const std::string& names, std::vector<std::string>& values, const std::string& meaning);
    Option add(const std::string& names, bool& value, const std::string& meaning);
    Option add(const std::string& names, double& value, const Bounds& bounds, const std::string& meaning);
    Option add(const std::string& names, std::optional<double>& value, const Bounds& bounds,
               const std::string& meaning);
    Option add(const std::string& names, long& value, const Bounds& bounds, const std::string& meaning);
    // --json, which commands that print facts have.
    Option add_json(bool& value);

private:
    CLI::App* app_;
    Suggestions* suggestions_;
};

// All commands, and the command line that chooses one of them.
class CommandList {
public:
    CommandList(const std::string& description, std::function<std::string()> version);
    CommandList(const CommandList&) = delete;
    CommandList& operator=(const CommandList&) = delete;
    ~CommandList();

    // A command and its options, which hold their defaults until the line is read and live as long as the list.
    template <class Options>
    std::pair<Command, Options&> add(const char* name, const char* meaning, io::ExitCode (*function)(const Options&)) {
        auto options = std::make_shared<Options>();
        return {add(name, meaning, [options, function] { return function(*options); }), *options};
    }
    // An option of every command.
    Option add(const std::string& names, std::string& value, const std::string& meaning);
    Option add(const std::string& names, bool& value, const std::string& meaning);

    // False where all is said with `code`: the help was asked for, or the line is wrong.
    [[nodiscard]] bool parse(int argc, char** argv, io::ExitCode& code);
    io::ExitCode run() const;

    // What every command has comes first, without a name.
    std::vector<CommandHelp> help() const;

private:
    Command add(const char* name, const char* meaning, std::function<io::ExitCode()> function);
    // What to say where the line names no command that there is; empty where it does.
    std::string expected_command(const std::vector<std::string>& words) const;
    // The same of an option.
    std::string expected_option(const std::vector<std::string>& words) const;

    std::unique_ptr<CLI::App> app_;
    Suggestions suggestions_;
    std::vector<std::pair<CLI::App*, std::function<io::ExitCode()>>> commands_;
};

}  // namespace hamilcar::cli
