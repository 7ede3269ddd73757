// An open netCDF file. Throws Error(input_output), or Error(bad_file) for what is no netCDF classic file with all that its
// header tells of.
#pragma once

#include <netcdf.h>

#include <string>
#include <vector>

namespace hamilcar::io {

class NetcdfFile {
public:
    enum class Mode { read, create };

    // `buffer`: of the library [byte].
    NetcdfFile(const std::string& path, Mode mode, std::size_t buffer = std::size_t{1} << 20);
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;
    ~NetcdfFile() { release(); }

    int id() const { return id_; }
    bool is_open() const { return id_ >= 0; }
    const std::string& path() const { return path_; }
    void rename(const std::string& path) { path_ = path; }

    void check(int status, const std::string& action) const;
    // Of an attribute that is text; empty where there is none.
    std::string text(int variable, const char* attribute) const;
    void set_text(int variable, const std::string& attribute, const std::string& text) const;
    int define_dimension(const char* name, std::size_t length) const;
    int define_variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) const;
    void close();
    void release() noexcept;  // closes it, whatever comes of that
    void abort() noexcept;    // and removes it, if its header was not written yet

private:
    std::string path_;
    int id_ = -1;
};

}  // namespace hamilcar::io
