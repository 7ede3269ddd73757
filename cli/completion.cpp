// `hamilcar completion SHELL`: a script that lets the shell complete commands, options and their words. All is taken from the help, so a
// new command or option is in it.
#include <fmt/format.h>

#include "commands.hpp"
#include "files.hpp"

namespace hamilcar::cli {

namespace {

std::string joined(const std::vector<std::string>& words, const char* between = " ") {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
    return out;
}

// As one word of any of these shells.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + "'";
}

std::vector<std::string> names_of(const std::vector<CommandHelp>& all) {
    std::vector<std::string> names;
    for (const CommandHelp& command : all) {
        if (!command.name.empty()) names.push_back(command.name);
    }
    names.emplace_back("help");
    return names;
}

std::string bash_case(const CommandHelp& command, const std::vector<OptionHelp>& everywhere) {
    std::vector<std::string> options;
    std::string values, place;
    for (const auto* list : {&command.options, &everywhere}) {
        for (const OptionHelp& option : *list) {
            options.insert(options.end(), option.names.begin(), option.names.end());
            if (option.words.empty()) continue;
            const std::string words = quoted(joined(option.words));
            if (option.names.empty()) {
                place = fmt::format("            words={}\n", words);
            } else {
                values += fmt::format("                {}) words={} ;;\n", joined(option.names, "|"), words);
            }
        }
    }
    std::string out = fmt::format("        {})\n            options={}\n{}", command.name.empty() ? "''" : command.name,
                                  quoted(joined(options)), place);
    if (!values.empty()) out += "            case $before in\n" + values + "            esac\n";
    return out + "            ;;\n";
}

std::string bash_script(const std::vector<CommandHelp>& all) {
    const std::string names = joined(names_of(all));
    std::string out =
        "# hamilcar for bash: source this file, or put it where bash-completion looks.\n"
        "_hamilcar() {\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= options= words= i\n"
        "    for ((i = 1; i < COMP_CWORD; ++i)); do\n"
        "        case ${COMP_WORDS[i]} in\n            " +
        joined(names_of(all), "|") +
        ") command=${COMP_WORDS[i]}; break ;;\n"
        "        esac\n"
        "    done\n"
        "    case $command in\n";
    for (const CommandHelp& command : all) out += bash_case(command, all[0].options);
    out += "        help) words=" + quoted(names) +
           " ;;\n"
           "    esac\n"
           "    if [[ $word == -* ]]; then\n"
           "        words=$options\n"
           "    elif [[ -z $command && -z $words ]]; then\n"
           "        words=" +
           quoted(names) +
           "\n"
           "    fi\n"
           "    if [[ -n $words ]]; then\n"
           "        COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
           "    else\n"
           "        compopt -o filenames 2>/dev/null\n"
           "        COMPREPLY=($(compgen -f -- \"$word\"))\n"
           "    fi\n"
           "}\n"
           "complete -F _hamilcar hamilcar\n";
    return out;
}

// '--output[meaning]:value:_files', for each of its names.
std::string zsh_argument(const OptionHelp& option) {
    const std::string value = option.words.empty() ? ":value:_files" : ":value:(" + joined(option.words) + ")";
    if (option.names.empty()) return quoted("*" + value);
    std::string meaning;
    for (const char c : option.meaning) meaning += (c == '[' || c == ']' || c == ':' ? "\\" : "") + std::string(1, c);
    std::string out;
    for (const std::string& name : option.names) {
        if (!out.empty()) out += ' ';
        out += quoted(fmt::format("{}[{}]{}", name, meaning, option.takes_value ? value : ""));
    }
    return out;
}

std::string zsh_script(const std::vector<CommandHelp>& all) {
    std::string everywhere, commands, cases;
    for (const OptionHelp& option : all[0].options) everywhere += " " + zsh_argument(option);
    for (const CommandHelp& command : all) {
        if (command.name.empty()) continue;
        commands += "        " + quoted(command.name + ":" + command.meaning) + "\n";
        std::string arguments;
        for (const OptionHelp& option : command.options) arguments += " " + zsh_argument(option);
        cases += fmt::format("                {}) _arguments{}{} ;;\n", command.name, arguments, everywhere);
    }
    return "#compdef hamilcar\n"
           "# hamilcar for zsh: put this as _hamilcar into a folder of $fpath.\n"
           "_hamilcar() {\n"
           "    local -a commands=(\n" +
           commands +
           "    )\n"
           "    _arguments -C" +
           everywhere +
           " '1:command:->command' '*::argument:->argument'\n"
           "    case $state in\n"
           "        command) _describe command commands ;;\n"
           "        argument)\n"
           "            case $words[1] in\n" +
           cases +
           "            esac ;;\n"
           "    esac\n"
           "}\n"
           "_hamilcar \"$@\"\n";
}

std::string fish_option(const OptionHelp& option, const std::string& condition) {
    if (option.names.empty()) {
        if (option.words.empty()) return "";
        return fmt::format("complete -c hamilcar {} -f -a {}\n", condition, quoted(joined(option.words)));
    }
    std::string out = "complete -c hamilcar " + condition;
    for (const std::string& name : option.names) {
        out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (option.takes_value) out += option.words.empty() ? " -r" : " -x -a " + quoted(joined(option.words));
    return out + " -d " + quoted(option.meaning) + "\n";
}

std::string fish_script(const std::vector<CommandHelp>& all) {
    std::string out = "# hamilcar for fish: put this into ~/.config/fish/completions as hamilcar.fish.\n";
    for (const CommandHelp& command : all) {
        if (!command.name.empty()) {
            out += fmt::format("complete -c hamilcar -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                               quoted(command.meaning));
        }
        const std::string condition =
            command.name.empty() ? "" : "-n '__fish_seen_subcommand_from " + command.name + "'";
        for (const OptionHelp& option : command.options) out += fish_option(option, condition);
    }
    return out;
}

struct CompletionOptions {
    const CommandList* list = nullptr;
    std::string shell, output;
};

io::ExitCode completion(const CompletionOptions& options) {
    const std::vector<CommandHelp> all = options.list->help();
    print_or_write(options.output, options.shell == "bash"  ? bash_script(all)
                                   : options.shell == "zsh" ? zsh_script(all)
                                                            : fish_script(all));
    return io::ExitCode::ok;
}

}  // namespace

void add_completion(CommandList& list) {
    auto [command, o] = list.add<CompletionOptions>(
        "completion", "print a script by which the shell completes commands, options and names", completion);
    o.list = &list;
    command.add("shell", o.shell, "bash, zsh or fish").required().one_of({"bash", "zsh", "fish"});
    command.add("-o,--output", o.output, "file for the script, instead of standard output");
}

}  // namespace hamilcar::cli
