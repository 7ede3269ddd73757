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
    const auto check = [words](std::string& word) {
        const std::vector<std::string_view> known(words.begin(), words.end());
        if (std::ranges::find(known, word) != known.end()) return std::string();
        const auto nearest = io::nearest_word(word, known);
        return fmt::format("'{}': expected {}{}", word, io::quoted_list(known),
                           nearest ? fmt::format("; did you mean '{}'?", *nearest) : "");
    };
    option_->check(CLI::Validator(check, "", "WORD"));
    return suggest(std::move(words));
}
Option& Option::suggest(std::vector<std::string> words) {
    (*suggestions_)[option_] = std::move(words);
    return *this;
}

Option Command::add(const std::string& names, std::string& value, const std::string& meaning) {
    return {app_->add_option(names, value, with_default(meaning, value)), *suggestions_};
}
Option Command::add(const std::string& names, std::vector<std::string>& values, const std::string& meaning) {
    CLI::Option* option = app_->add_option(names, values, meaning);
    if (names.starts_with('-')) option->allow_extra_args(false);  // one each time: what follows is another word
    return {option, *suggestions_};
}
Option Command::add(const std::string& names, bool& value, const std::string& meaning) {
    return {app_->add_flag(names, value, meaning), *suggestions_};
}
Option Command::add(const std::string& names, double& value, const Bounds& bounds, const std::string& meaning) {
    const std::string help = with_default(meaning, fmt::format("{:g}", value), bounds.unit);
    return {app_->add_option(names, value, help)->check(inside(bounds)), *suggestions_};
}
Option Command::add(const std::string& names, std::optional<double>& value, const Bounds& bounds,
                    const std::string& meaning) {
    return {app_->add_option(names, value, in_unit(meaning, bounds.unit))->check(inside(bounds)), *suggestions_};
}
Option Command::add(const std::string& names, long& value, const Bounds& bounds, const std::string& meaning) {
    const std::string help = with_default(meaning, fmt::format("{}", value), bounds.unit);
    return {app_->add_option(names, value, help)->check(inside(bounds)), *suggestions_};
}
Option Command::add_json(bool& value) {
    return add("--json", value, "print the facts as one JSON object on standard output");
}

CommandList::CommandList(const std::string& description, std::function<std::string()> version)
    : app_(std::make_unique<CLI::App>(description)) {
    app_->set_version_flag("-V,--version", std::move(version));
    app_->fallthrough();
    app_->require_subcommand(1);
}

CommandList::~CommandList() = default;

Command CommandList::add(const char* name, const char* meaning, std::function<io::ExitCode()> function) {
    commands_.emplace_back(app_->add_subcommand(name, meaning), std::move(function));
    return {commands_.back().first, suggestions_};
}

Option CommandList::add(const std::string& names, std::string& value, const std::string& meaning) {
    return Command(app_.get(), suggestions_).add(names, value, meaning);
}

Option CommandList::add(const std::string& names, bool& value, const std::string& meaning) {
    return Command(app_.get(), suggestions_).add(names, value, meaning);
}

bool CommandList::parse(int argc, char** argv, io::ExitCode& code) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (!words.empty() && words[0] == "help") {  // hamilcar help run: hamilcar run --help
        words.erase(words.begin());
        words.push_back("--help");
    }
    try {
        app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the end
        return true;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {  // --help, --version
            app_->exit(error);
            code = io::ExitCode::ok;
            return false;
        }
        std::string expected = expected_command(words);
        if (expected.empty() && dynamic_cast<const CLI::ExtrasError*>(&error)) expected = expected_option(words);
        const auto asked = std::ranges::find_if(commands_, [](const auto& one) { return one.first->parsed(); });
        fmt::print(stderr, "hamilcar: {}\nTry 'hamilcar{} --help'.\n", expected.empty() ? error.what() : expected,
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
std::string CommandList::expected_command(const std::vector<std::string>& words) const {
    std::vector<std::string_view> names;
    for (const auto& [command, function] : commands_) names.push_back(command->get_name());
    if (words.empty()) return "expected a command: " + io::quoted_list(names);
    if (words[0].starts_with('-') || std::ranges::find(names, words[0]) != names.end()) return {};
    const auto nearest = io::nearest_word(words[0], names);
    return fmt::format("unknown command '{}': expected {}{}", words[0], io::quoted_list(names),
                       nearest ? fmt::format("; did you mean '{}'?", *nearest) : "");
}

std::string CommandList::expected_option(const std::vector<std::string>& words) const {
    std::vector<std::string> known;
    for (const CommandHelp& command : help()) {
        const bool asked = command.name.empty() || std::ranges::find(words, command.name) != words.end();
        if (!asked) continue;
        for (const OptionHelp& option : command.options)
            known.insert(known.end(), option.names.begin(), option.names.end());
    }
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (!name.starts_with("--") || std::ranges::find(known, name) != known.end()) continue;
        const std::vector<std::string_view> names(known.begin(), known.end());
        const auto nearest = io::nearest_word(name, names);
        return fmt::format(
            "unknown option '{}': {}", name,
            nearest ? fmt::format("did you mean '{}'?", *nearest) : "expected " + io::quoted_list(names));
    }
    return {};
}

std::vector<CommandHelp> CommandList::help() const {
    const auto described = [&](const CLI::App& app, const std::string& name) {
        CommandHelp out{.name = name, .meaning = app.get_description(), .options = {}};
        for (const CLI::Option* option : app.get_options()) {
            OptionHelp one{.names = {},
                           .placeholder = option->get_positional() ? option->get_name() : "",
                           .meaning = option->get_description(),
                           .takes_value = option->get_items_expected_max() > 0,
                           .words = {}};
            for (const std::string& letter : option->get_snames()) one.names.push_back("-" + letter);
            for (const std::string& word : option->get_lnames()) one.names.push_back("--" + word);
            if (const auto words = suggestions_.find(option); words != suggestions_.end()) one.words = words->second;
            out.options.push_back(std::move(one));
        }
        return out;
    };
    std::vector<CommandHelp> out{described(*app_, "")};
    for (const auto& [command, function] : commands_) out.push_back(described(*command, command->get_name()));
    return out;
}

}  // namespace hamilcar::cli
