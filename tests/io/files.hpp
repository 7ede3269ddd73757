// Files for the tests of this room: the repository's own, and changed copies in a folder that goes away.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "hamilcar/io/error.hpp"
#include "support/paths.hpp"

namespace hamilcar::io {

inline std::string repository_path(const std::string& path) {
    return test::source_path(path);
}

inline std::string read_file(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

// The shipped car's file, for changed copies elsewhere: it names its tire file by the whole path.
inline const std::string& shipped_car_text() {
    static const std::string text = [] {
        std::string file = read_file(repository_path("vehicles/bmw_323i.toml"));
        return file.replace(file.find("\"tires/"), 1, "\"" + repository_path("vehicles/"));
    }();
    return text;
}

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "hamilcar-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return path_ + "/" + name; }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(*this / name) << text;
        return *this / name;
    }

private:
    std::string path_;
};

// The text with one occurrence changed; the test's own mistake if there is none.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "not in the file: " << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

// "line:column" of the first occurrence.
inline std::string position_in(const std::string& text, const std::string& what) {
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << "not in the file: " << what;
    const auto line_begin = at == 0 ? 0 : text.rfind('\n', at - 1) + 1;
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    return std::to_string(line) + ":" + std::to_string(at - line_begin + 1);
}

// The action ends with one Error of that code whose message, a line for each mistake, contains all these pieces.
inline void expect_error(const std::function<void()>& action, ExitCode code, const std::vector<std::string>& pieces) {
    try {
        action();
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(error.code(), code) << message;
        for (const std::string& piece : pieces) EXPECT_THAT(message, testing::HasSubstr(piece));
        const std::string counted = std::to_string(std::count(message.begin(), message.end(), '\n')) + " mistakes\n";
        EXPECT_TRUE(message.find('\n') == std::string::npos || message.starts_with(counted)) << message;
    }
}

// One mistake in an otherwise right file.
struct BadInput {
    std::string name, from, to;       // what is changed
    std::string at;                   // the text whose position the message names
    std::vector<std::string> pieces;  // of the message
};

// The name a test runner shows.
inline void PrintTo(const BadInput& bad, std::ostream* out) {
    *out << bad.name;
}

inline void expect_refused(const std::string& good, const BadInput& bad, const std::function<void(std::string)>& read) {
    const TemporaryFolder folder;
    const std::string text = changed(good, bad.from, bad.to), path = folder.write("changed.toml", text);
    std::vector<std::string> pieces = bad.pieces;
    pieces.push_back(path + ":" + position_in(text, bad.at) + ": ");
    expect_error([&] { read(path); }, ExitCode::bad_file, pieces);
}

}  // namespace hamilcar::io
