#include "hamilcar/io/netcdf_file.hpp"

#include <utility>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/netcdf_header.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

NetcdfFile::NetcdfFile(const std::string& path, Mode mode, std::size_t buffer) : path_(path) {
    if (mode == Mode::create) {
        expect_writable_place(path);  // the library deletes what it could not create, a device node too
        check(nc__create(path.c_str(), NC_CLOBBER | NC_64BIT_OFFSET, 0, &buffer, &id_), "open for writing");
    } else {
        check_netcdf_header(path);
        check(nc__open(path.c_str(), NC_NOWRITE, &buffer, &id_), "read");
    }
}

void NetcdfFile::check(int status, const std::string& action) const {
    if (status == NC_NOERR) return;
    throw Error(ExitCode::input_output, path_ + ": cannot " + action + ": " + nc_strerror(status));
}

std::string NetcdfFile::text(int variable, const char* attribute) const {
    std::size_t length = 0;
    nc_type type = NC_NAT;
    if (nc_inq_att(id_, variable, attribute, &type, &length) != NC_NOERR || type != NC_CHAR) return {};
    std::string value(length, '\0');
    check(nc_get_att_text(id_, variable, attribute, value.data()), std::string("read the attribute ") + attribute);
    return value;
}

void NetcdfFile::set_text(int variable, const std::string& attribute, const std::string& text) const {
    check(nc_put_att_text(id_, variable, attribute.c_str(), text.size(), text.data()), "set an attribute");
}

int NetcdfFile::define_dimension(const char* name, std::size_t length) const {
    int dimension = 0;
    check(nc_def_dim(id_, name, length, &dimension), std::string("define the dimension ") + name);
    return dimension;
}

int NetcdfFile::define_variable(const std::string& name, nc_type type, const std::vector<int>& dimensions) const {
    int variable = 0;
    check(nc_def_var(id_, name.c_str(), type, static_cast<int>(dimensions.size()), dimensions.data(), &variable),
          "define " + name);
    return variable;
}

void NetcdfFile::close() {
    if (is_open()) check(nc_close(std::exchange(id_, -1)), "close");
}

void NetcdfFile::release() noexcept {
    if (is_open()) nc_close(std::exchange(id_, -1));
}

void NetcdfFile::abort() noexcept {
    if (is_open()) nc_abort(std::exchange(id_, -1));
}

}  // namespace hamilcar::io
