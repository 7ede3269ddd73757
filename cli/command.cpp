#include "command.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "hamilcar/io/spelling.hpp"

namespace hamilcar::cli {

namespace {

// CLI11's own range lets a NaN through.
CLI::Validator inside(const Bounds& bounds) {
    const std::string unit = *bounds.unit ? fmt::format(" {}", bounds.unit) : "";
    return CLI::Validator(
        [=](std::string& word) {
            double value = 0;
            const bool fits = CLI::detail::lexical_cast(word, value) && value >= bounds.min && value <= bounds.max;
            return fits
                       ? std::string()
                       : fmt::format("'{}': expected a number from {:g} to {:g}{}", word, bounds.min, bounds.max, unit);
        },
        fmt::format("[{:g} - {:g}]", bounds.min, bounds.max), "RANGE");
}

std::string with_default(const std::string& meaning, const std::string& value, const char* unit = "") {
    if (value.empty()) return meaning;
    return fmt::format("{} [{}{}{}]", meaning, value, *unit ? " " : "", unit);
}

std::string in_unit(const std::string& meaning, const char* unit) {
    return *unit ? fmt::format("{} [{}]", meaning, unit) : meaning;
}

}  // namespace

Option& Option::required() {
    option_->required();
    return *this;
}
Option& Option::needs(const Option& other) {
    option_->needs(other.option_);
    return *this;
}
Option& Option::excludes(const Option& other) {
    option_->excludes(other.option_);
    return *this;
}
Option& Option::one_of(std::vector<std::string> words) {
    const auto check = [words = std::move(words)](std::string& word) {
        const std::vector<std::string_view> known(words.begin(), words.end());
        if (std::ranges::find(known, word) != known.end()) return std::string();
        const auto nearest = io::nearest_word(word, known);
        return fmt::format("'{}': expected {}{}", word, io::quoted_list(known),
                           nearest ? fmt::format("; did you mean '{}'?", *nearest) : "");
    };
    option_->check(CLI::Validator(check, "", "WORD"));
    return *this;
}

Option Command::add(const std::string& names, std::string& value, const std::string& meaning) {
    return Option(app_->add_option(names, value, with_default(meaning, value)));
}
Option Command::add(const std::string& names, std::vector<std::string>& values, const std::string& meaning) {
    return Option(app_->add_option(names, values, meaning));
}
Option Command::add(const std::string& names, bool& value, const std::string& meaning) {
    return Option(app_->add_flag(names, value, meaning));
}
Option Command::add(const std::string& names, double& value, const Bounds& bounds, const std::string& meaning) {
    const std::string help = with_default(meaning, fmt::format("{:g}", value), bounds.unit);
    return Option(app_->add_option(names, value, help)->check(inside(bounds)));
}
Option Command::add(const std::string& names, std::optional<double>& value, const Bounds& bounds,
                    const std::string& meaning) {
    return Option(app_->add_option(names, value, in_unit(meaning, bounds.unit))->check(inside(bounds)));
}
Option Command::add(const std::string& names, long& value, const Bounds& bounds, const std::string& meaning) {
    const std::string help = with_default(meaning, fmt::format("{}", value), bounds.unit);
    return Option(app_->add_option(names, value, help)->check(inside(bounds)));
}
Option Command::add_json(bool& value) {
    return add("--json", value, "print the facts as one JSON object on standard output");
}

CommandList::CommandList(const std::string& description, std::function<std::string()> version)
    : app_(std::make_unique<CLI::App>(description)) {
    app_->set_version_flag("--version", std::move(version));
    app_->fallthrough();
    app_->require_subcommand(1);
}

CommandList::~CommandList() = default;

Command CommandList::add(const char* name, const char* meaning, std::function<io::ExitCode()> function) {
    commands_.emplace_back(app_->add_subcommand(name, meaning), std::move(function));
    return Command(commands_.back().first);
}

Option CommandList::add(const std::string& names, std::string& value, const std::string& meaning) {
    return Command(app_.get()).add(names, value, meaning);
}

bool CommandList::parse(int argc, char** argv, io::ExitCode& code) {
    try {
        app_->parse(argc, argv);
        return true;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {  // --help, --version
            app_->exit(error);
            code = io::ExitCode::ok;
            return false;
        }
        const std::string no_command = expected_command(argc, argv);
        const auto asked = std::ranges::find_if(commands_, [](const auto& one) { return one.first->parsed(); });
        fmt::print(stderr, "hamilcar: {}\nTry 'hamilcar{} --help'.\n", no_command.empty() ? error.what() : no_command,
                   asked == commands_.end() ? "" : " " + asked->first->get_name());
        code = io::ExitCode::usage;
        return false;
    }
}

io::ExitCode CommandList::run() const {
    for (const auto& [command, function] : commands_) {
        if (command->parsed()) return function();
    }
    return io::ExitCode::usage;
}

// CLI11 only says that a word is missing; all commands, or the nearest one to what was typed, help more.
std::string CommandList::expected_command(int argc, char** argv) const {
    std::vector<std::string_view> names;
    for (const auto& [command, function] : commands_) names.push_back(command->get_name());
    if (argc < 2) return "expected a command: " + io::quoted_list(names);
    if (argv[1][0] == '-' || std::ranges::find(names, argv[1]) != names.end()) return {};
    const auto nearest = io::nearest_word(argv[1], names);
    return fmt::format("unknown command '{}': expected {}{}", argv[1], io::quoted_list(names),
                       nearest ? fmt::format("; did you mean '{}'?", *nearest) : "");
}

}  // namespace hamilcar::cli
