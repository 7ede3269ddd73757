// The commands of `hamilcar`, each a function of its options; messages go to standard error, facts to standard output.
#pragma once

#include <string>

#include "hamilcar/io/error.hpp"

namespace hamilcar::cli {

struct Options {
    std::string file;    // scenario or vehicle
    std::string output;  // -o: folder
    bool json = false;   // one JSON object on standard output
};

io::ExitCode run(const Options& options);
io::ExitCode paper(const Options& options);
io::ExitCode check(const Options& options);

// Creates a folder with its parents; throws io::Error(input_output).
void make_folder(const std::string& path);
// Writes a whole small file; throws io::Error(input_output).
void write_file(const std::string& path, const std::string& text);

// Runs `f`; an error that it throws gets the file's name in front.
template <class F>
auto in_file(const std::string& path, F&& f) {
    try {
        return f();
    } catch (const io::Error& error) {
        throw io::Error(error.code(), path + ": " + error.what());
    }
}

// True once Ctrl-C was pressed; `watch_interrupt` starts watching.
void watch_interrupt();
bool interrupted();

}  // namespace hamilcar::cli
