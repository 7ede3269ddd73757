// Files that are read or written whole. What is read is a regular file of bounded size, so that a device, a pipe or a
// mistaken name ends in a message instead of waiting or filling the memory. What is written appears complete or not at
// all: it is written under a name that cannot be guessed, and then moved; a link is never written through.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace hamilcar::io {

// The largest files that are read whole, each many times what people write [byte].
struct FileLimit {
    static constexpr std::size_t toml = std::size_t{4} << 20;
    static constexpr std::size_t tire = 4'000'000;
    static constexpr std::size_t columns = std::size_t{256} << 20;
    static constexpr std::size_t road = std::size_t{1} << 30;
    static constexpr std::size_t outcome = std::size_t{256} << 20;
    static constexpr std::size_t checkpoint = std::size_t{1} << 30;
};

// `place` stands before every message: the key that names the file. Throws Error: input_output for what cannot be read
// or is no regular file, bad_file for more than `max` bytes.
std::string read_whole_file(const std::string& path, std::size_t max, const std::string& place = {});

// Its bytes. Throws Error(input_output) for what cannot be read or is no regular file.
std::uintmax_t regular_file_size(const std::string& path);

// The first bytes of a regular file, at most so many; empty where there is none or it cannot be read.
std::string file_beginning(const std::string& path, std::size_t bytes);

// Throws Error(input_output); what was at `path` before is then still there. On the disk when it returns.
void write_whole_file(const std::string& path, std::initializer_list<std::string_view> parts);

// An empty file in the folder of `path` under a name of its own, for who writes it bit by bit and moves it to `path`.
std::string create_beside(const std::string& path);
// Removes what such files were left of `path`, by programs that were killed. For who has the folder alone.
void remove_left_beside(const std::string& path);
// Gives a file that was written under another name of the same folder its own, on the disk too. Throws Error(input_output).
void put_in_place(const std::string& name, const std::string& path);
// Throws Error(input_output) where `path` is a link, a device, a folder: anything but a regular file or nothing.
void expect_writable_place(const std::string& path);

}  // namespace hamilcar::io
