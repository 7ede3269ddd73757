#include "browser.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace hamilcar::cli {

namespace {

namespace fs = std::filesystem;

bool is_set(const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
}

// Of a session of its own, so that Ctrl-C in the terminal ends this program and not the browser.
bool start_browser(std::string target) {
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return false;
    std::string program = "xdg-open";
    char* const arguments[] = {program.data(), target.data(), nullptr};
    posix_spawn_file_actions_t streams;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&streams) != 0) return false;
    bool started = false;
    if (posix_spawnattr_init(&attributes) == 0) {
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
        posix_spawn_file_actions_addopen(&streams, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&streams, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        pid_t child = 0;
        started = posix_spawnp(&child, program.c_str(), &streams, &attributes, arguments, environ) == 0;
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&streams);
    return started;
}

// Empty if it cannot be written.
std::string write_private(const std::string& folder, std::string_view text) {
    std::error_code error;
    fs::create_directories(folder, error);
    constexpr std::string_view ending = ".html";
    std::string path = fmt::format("{}/open-XXXXXX{}", fs::absolute(folder).string(), ending);
    const int file = ::mkostemps(path.data(), static_cast<int>(ending.size()), O_CLOEXEC);  // for its owner alone
    if (file < 0) return {};
    const bool written = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    if (::close(file) == 0 && written) return path;
    ::unlink(path.c_str());
    return {};
}

}  // namespace

void open_in_browser(const std::string& path) {
    if (!start_browser(path)) fmt::print(stderr, "hamilcar: no browser could be started; open {} yourself\n", path);
}

SecretPage::SecretPage(const std::string& folder, const std::string& address)
    : path_(write_private(folder, fmt::format("<!doctype html><meta charset=\"utf-8\"><title>Hamilcar</title>\n"
                                              "<meta name=\"referrer\" content=\"no-referrer\">\n"
                                              "<meta http-equiv=\"refresh\" content=\"0; url={0}\">\n"
                                              "<a href=\"{0}\">Drive</a>\n",
                                              address))) {
    if (path_.empty() || !start_browser(path_)) fmt::print(stderr, "hamilcar: no browser could be started\n");
}

SecretPage::~SecretPage() {
    if (!path_.empty()) ::unlink(path_.c_str());
}

}  // namespace hamilcar::cli
