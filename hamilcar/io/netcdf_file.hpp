// netCDF classic files: one that is read, and one that is written from its beginning to its end. Throws Error(input_output),
// or Error(bad_file) for what is no netCDF classic file with all that its header tells of.
#pragma once

#include <cstdio>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/io/netcdf_header.hpp"

namespace hamilcar::io {

class NetcdfReader {
public:
    explicit NetcdfReader(const std::string& path);

    const NetcdfHeader& header() const { return header_; }
    const std::string& path() const { return path_; }
    // All numbers of a variable, the last dimension the fastest. Characters are no numbers.
    std::vector<double> numbers(const NetcdfVariable& variable);
    // Of variables with one number a record, or over one fixed dimension of the same length, all numbers.
    std::vector<std::vector<double>> series(std::span<const std::size_t> variables);

private:
    std::string bytes(std::uint64_t begin, std::uint64_t count);

    std::string path_;
    NetcdfHeader header_;
    std::ifstream file_;
};

// Whatever goes wrong, the number of records in the file's header stays that of the last `flush`, and a reader believes it.
class NetcdfOutput {
public:
    // Writes the header. What was begun of a file that cannot take it is removed.
    NetcdfOutput(const std::string& path, NetcdfHeader header);

    const std::string& path() const { return path_; }
    void rename(const std::string& path) { path_ = path; }
    bool is_open() const { return file_ != nullptr; }

    // The next numbers, padded, of one variable after the other and then of record after record. `action` is for messages: "write row at t = 1 s". After an error the file is closed.
    void write(std::string_view bytes, std::string_view action);
    // So many records are complete. For others to see.
    void flush(std::uint64_t records, std::string_view action);
    void close();

private:
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    [[noreturn]] void fail(std::string_view action);

    std::string path_;
    std::unique_ptr<std::FILE, Close> file_;
};

// A file without records, complete or not at all: `bytes` are the numbers of its variables, in their order, each padded.
void write_netcdf(const std::string& path, const NetcdfHeader& header, std::string_view bytes);

}  // namespace hamilcar::io
