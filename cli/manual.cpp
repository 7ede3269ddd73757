// `hamilcar manual`: the manual page, for man(1), from the help of all commands.
#include <fmt/format.h>

#include "commands.hpp"
#include "files.hpp"

namespace hamilcar::cli {

namespace {

// What troff takes for itself: backslashes, minus signs as hyphens, dots and quotes that begin a line.
std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) out += "\\&";
            out += c;
        }
    }
    return out;
}

std::string synopsis(const CommandHelp& command) {
    std::string out = "\\fBhamilcar " + command.name + "\\fR";
    for (const OptionHelp& option : command.options) {
        if (option.names.empty()) out += " \\fI" + escaped(option.placeholder) + "\\fR";
    }
    return out + " [options]";
}

std::string option_entries(const CommandHelp& command) {
    std::string out;
    for (const OptionHelp& option : command.options) {
        std::string names;
        for (const std::string& name : option.names)
            names += (names.empty() ? "" : ", ") + ("\\fB" + escaped(name) + "\\fR");
        if (option.names.empty()) names = "\\fI" + escaped(option.placeholder) + "\\fR";
        if (option.takes_value && !option.names.empty()) names += " \\fIvalue\\fR";
        out += ".TP\n" + names + "\n" + escaped(option.meaning) + "\n";
    }
    return out;
}

std::string manual_page(const std::vector<CommandHelp>& all) {
    std::string out =
        ".TH HAMILCAR 1 \"\" \"hamilcar " HAMILCAR_VERSION
        "\"\n.SH NAME\nhamilcar \\- simulate wheeled vehicles with their real suspension linkages\n.SH SYNOPSIS\n";
    for (std::size_t i = 1; i < all.size(); ++i) out += (i > 1 ? ".br\n" : "") + synopsis(all[i]) + "\n";
    out += ".SH OPTIONS\nOf every command:\n" + option_entries(all[0]) + ".SH COMMANDS\n";
    for (std::size_t i = 1; i < all.size(); ++i) {
        out += ".SS hamilcar " + all[i].name + "\n" + escaped(all[i].meaning) + ".\n" + option_entries(all[i]);
    }
    out += ".SH EXIT STATUS\n";
    for (const auto& [code, meaning] : {std::pair{"0", "done"},
                                        {"1", "a criterion was not met"},
                                        {"2", "the command line"},
                                        {"3", "a file"},
                                        {"4", "numerical failure"},
                                        {"5", "input, output or memory"},
                                        {"6", "a fault of the program's own"},
                                        {"130", "interrupted"}}) {
        out += fmt::format(".TP\n{}\n{}\n", code, escaped(meaning));
    }
    return out;
}

struct ManualOptions {
    const CommandList* list = nullptr;
    std::string output;
};

io::ExitCode manual(const ManualOptions& options) {
    print_or_write(options.output, manual_page(options.list->help()));
    return io::ExitCode::ok;
}

}  // namespace

void add_manual(CommandList& list) {
    auto [command, o] = list.add<ManualOptions>("manual", "print the manual page (hamilcar manual | man -l -)", manual);
    o.list = &list;
    command.add("-o,--output", o.output, "file for the page, instead of standard output");
}

}  // namespace hamilcar::cli
