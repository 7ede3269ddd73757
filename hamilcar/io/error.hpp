// What a person's mistake looks like: one message that says where, which key, what value, what was expected.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace hamilcar::io {

// Exit codes of every command, also the category of an Error.
enum class ExitCode : int {
    ok = 0,
    failed = 1,        // a check or run did not meet its criterion
    usage = 2,         // command line
    bad_file = 3,      // vehicle or scenario file
    numerical = 4,     // no assembly, singular linkage, non-finite state
    input_output = 5,  // a path that cannot be read or written, a full disk, no memory
    internal = 6,      // a fault of the program's own
    interrupted = 130
};

class Error : public std::runtime_error {
public:
    // `key` is the dotted key of a file that the message is about, so that its place in the file can be found.
    Error(ExitCode code, const std::string& message, std::string key = {})
        : std::runtime_error(message), code_(code), key_(std::move(key)) {}
    ExitCode code() const { return code_; }
    const std::string& key() const { return key_; }

private:
    ExitCode code_;
    std::string key_;
};

}  // namespace hamilcar::io
