// What every command needs from the operating system: folders, small files, Ctrl-C.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "commands.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::cli {

namespace {
volatile std::sig_atomic_t interrupt_seen = 0, interrupt_watched = 0;
extern "C" void on_interrupt(int) {
    if (!interrupt_watched) _exit(static_cast<int>(io::ExitCode::interrupted));
    interrupt_seen = 1;
}
}  // namespace

bool take_standard_streams() {
    bool output_is_open = true;
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) != -1) continue;
        if (stream == STDOUT_FILENO) output_is_open = false;
        if (::open("/dev/null", O_RDWR) != stream) return false;  // the lowest number that is free
    }
    return output_is_open;
}

void end_on_interrupt() {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second Ctrl-C ends the program at once
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGHUP, &action, nullptr);  // the terminal is closed
    std::signal(SIGXFSZ, SIG_IGN);        // a file beyond `ulimit -f` is like a full disk: the write says so
}

InterruptWatch::InterruptWatch() {
    interrupt_watched = 1;
}

InterruptWatch::~InterruptWatch() {
    interrupt_watched = 0;
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

io::FolderLock take_folder(const std::string& path) {
    make_folder(path);
    return io::FolderLock(path);
}

void write_file(const std::string& path, const std::string& text) {
    io::write_whole_file(path, {text});
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
