// What every command needs from the operating system: folders, small files, Ctrl-C.
#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "commands.hpp"

namespace hamilcar::cli {

namespace {
volatile std::sig_atomic_t interrupt_seen = 0;
extern "C" void on_interrupt(int) {
    interrupt_seen = 1;
}
}  // namespace

void watch_interrupt() {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second Ctrl-C ends the program at once
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);  // the terminal is closed
    std::signal(SIGXFSZ, SIG_IGN);        // a file beyond `ulimit -f` is like a full disk: the write says so
}

bool interrupted() {
    return interrupt_seen != 0;
}

std::string shipped_file(const std::string& name) {
    for (const std::string& folder :
         {std::string("."), std::string(HAMILCAR_SOURCE_DATA), std::string(HAMILCAR_INSTALLED_DATA)}) {
        const std::string path = fmt::format("{}/{}", folder, name);
        if (std::filesystem::exists(path)) return path;
    }
    throw io::Error(io::ExitCode::input_output,
                    name + ": not found here, in the source or where hamilcar is installed");
}

std::set<std::string> tire_files(const VehicleDescription& vehicle) {
    std::set<std::string> files;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        if (const auto* magic = std::get_if<MagicFormulaDescription>(&wheel.tire)) files.insert(magic->name);
    });
    return files;
}

void make_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error || !std::filesystem::is_directory(path)) {
        throw io::Error(io::ExitCode::input_output,
                        fmt::format("{}: cannot create the output folder: {}", path,
                                    error ? error.message() : "a file of that name exists"));
    }
}

void write_file(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file)
        throw io::Error(io::ExitCode::input_output, fmt::format("{}: cannot write: {}", path, std::strerror(errno)));
}

void check_output(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (!std::filesystem::exists(path) || extension == ".html" || extension == ".htm") return;
    throw io::Error(io::ExitCode::usage,
                    "--output: " + path + " is there and is no page: expected a new file, or .html");
}

void print_or_write(const std::string& output, const std::string& text) {
    if (output.empty()) {
        fmt::print("{}", text);
    } else {
        write_file(output, text);
    }
}

}  // namespace hamilcar::cli
