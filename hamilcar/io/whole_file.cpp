#include "hamilcar/io/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "hamilcar/base/event_log.hpp"
#include "hamilcar/io/error.hpp"

namespace hamilcar::io {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t random_digits = 16;  // of a name that cannot be guessed

// A file descriptor that closes itself.
class OpenFile {
public:
    explicit OpenFile(int number) : number_(number) {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile() {
        if (number_ >= 0) ::close(number_);
    }
    int number() const { return number_; }
    bool close() { return ::close(std::exchange(number_, -1)) == 0; }

private:
    int number_;
};

// What is there is a file, but nothing that ends: a pipe, a device, a folder.
[[noreturn]] void refuse_kind(const std::string& path, const std::string& action, mode_t mode) {
    const char* kind = S_ISDIR(mode)    ? "Is a directory"
                       : S_ISFIFO(mode) ? "is a pipe, expected a regular file"
                       : S_ISLNK(mode)  ? "is a link, expected a regular file"
                                        : "is a device, expected a regular file";
    throw Error(ExitCode::input_output, fmt::format("{}: cannot {}: {}", path, action, kind));
}

bool write_all(int file, std::string_view rest) {
    while (!rest.empty()) {
        const ssize_t taken = ::write(file, rest.data(), rest.size());
        if (taken < 0 && errno == EINTR) continue;
        if (taken < 0) return false;
        rest.remove_prefix(static_cast<std::size_t>(taken));
    }
    return true;
}

// A file that no other program has opened, and its name.
std::pair<int, std::string> open_beside(const std::string& path) {
    for (;;) {
        std::uint64_t number = 0;
        if (::getrandom(&number, sizeof number, 0) != sizeof number) return {-1, {}};
        std::string name = fmt::format("{}.{:016x}.part", path, number);
        const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (file >= 0 || errno != EEXIST) return {file, name};
    }
}

// A new name is safe from a power cut once the folder is on the disk. Some file systems cannot do that, and need not.
void sync_folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    const OpenFile file(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (file.number() >= 0) ::fsync(file.number());
}

[[noreturn]] void fail_to_read(const std::string& path, int cause) {
    throw Error(ExitCode::input_output, fmt::format("{}: cannot read: {}", path, std::strerror(cause)));
}

[[noreturn]] void fail_to_write(const std::string& path, int cause) {
    throw Error(ExitCode::input_output, fmt::format("{}: cannot write: {}", path, std::strerror(cause)));
}

}  // namespace

std::uintmax_t regular_file_size(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0) fail_to_read(path, errno);
    if (!S_ISREG(status.st_mode)) refuse_kind(path, "read", status.st_mode);
    return static_cast<std::uintmax_t>(status.st_size);
}

std::string read_whole_file(const std::string& path, std::size_t max, const std::string& place) {
    // Not blocking: who opens a pipe would wait for its other end.
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (file.number() < 0 || ::fstat(file.number(), &status) != 0) fail_to_read(place + path, errno);
    if (!S_ISREG(status.st_mode)) refuse_kind(place + path, "read", status.st_mode);
    const auto refuse_size = [&] {
        throw Error(ExitCode::bad_file,
                    fmt::format("{}{}: larger than {} MB: expected a smaller file", place, path, max / 1'000'000));
    };
    if (static_cast<std::uintmax_t>(status.st_size) > max) refuse_size();
    std::string text(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t filled = 0;
    for (;;) {  // to the end, which may lie elsewhere than the size says: the kernel's own files have none
        if (filled == text.size()) text.resize(filled + (std::size_t{1} << 16));
        const ssize_t count = ::read(file.number(), text.data() + filled, text.size() - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_to_read(place + path, errno);
        if (count == 0) break;
        filled += static_cast<std::size_t>(count);
        if (filled > max) refuse_size();
    }
    if (events_are_logged()) log_event(fmt::format("read {}, {} bytes", path, filled));
    text.resize(filled);
    return text;
}

std::string file_beginning(const std::string& path, std::size_t bytes) {
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    struct stat status {};
    if (file.number() < 0 || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
    std::string text(bytes, '\0');
    const ssize_t count = ::read(file.number(), text.data(), bytes);
    text.resize(count < 0 ? 0 : static_cast<std::size_t>(count));
    return text;
}

void expect_writable_place(const std::string& path) {
    struct stat status {};
    if (::lstat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return;
    refuse_kind(path, "write", status.st_mode);
}

std::string create_beside(const std::string& path) {
    expect_writable_place(path);
    const auto [file, name] = open_beside(path);
    if (file < 0) fail_to_write(path, errno);
    ::close(file);
    return name;
}

void remove_left_beside(const std::string& path) {
    const std::string begin = fs::path(path).filename().string() + ".", end = ".part";
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(fs::path(path).parent_path(), unreadable)) {
        const std::string name = entry.path().filename().string();
        if (name.size() != begin.size() + random_digits + end.size()) continue;
        if (name.starts_with(begin) && name.ends_with(end)) fs::remove(entry.path(), unreadable);
    }
}

void write_whole_file(const std::string& path, std::initializer_list<std::string_view> parts) {
    expect_writable_place(path);
    const auto [number, name] = open_beside(path);
    if (number < 0) fail_to_write(path, errno);
    OpenFile file(number);
    bool written = true;
    for (const std::string_view part : parts) written = written && write_all(number, part);
    written = written && ::fsync(number) == 0;
    int cause = errno;
    if (written && !file.close()) written = false, cause = errno;
    if (written && ::rename(name.c_str(), path.c_str()) != 0) written = false, cause = errno;
    if (written) return sync_folder_of(path);
    std::error_code gone;
    fs::remove(name, gone);
    fail_to_write(path, cause);
}

void put_in_place(const std::string& name, const std::string& path) {
    const OpenFile file(::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
    if (file.number() < 0 || ::fsync(file.number()) != 0 || ::rename(name.c_str(), path.c_str()) != 0) {
        throw Error(ExitCode::input_output,
                    fmt::format("{}: cannot put the file in its place: {}", path, std::strerror(errno)));
    }
    sync_folder_of(path);
}

}  // namespace hamilcar::io
