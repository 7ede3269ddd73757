// Sizes are recomputed from the dimensions. What the variables hold in all must fit into the file: variables that share their
// bytes would make a small file a large memory.
#include "hamilcar/io/netcdf_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::array<std::uint64_t, 12> type_sizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // [byte]
constexpr std::uint64_t max_rank = 1024;                                                 // as in Unidata's library
constexpr double max_values = 1e18;                         // beyond any file, within 64 bits
constexpr std::uint64_t farthest = std::uint64_t{1} << 62;  // likewise [byte]

std::string text_of(const std::vector<NetcdfAttribute>& attributes, std::string_view name) {
    const auto found = std::ranges::find(attributes, name, &NetcdfAttribute::name);
    return found == attributes.end() ? std::string() : found->text;
}

template <class Named>
std::optional<std::size_t> index_of(const std::vector<Named>& all, std::string_view name) {
    const auto found = std::ranges::find(all, name, &Named::name);
    if (found == all.end()) return {};
    return static_cast<std::size_t>(found - all.begin());
}

class HeaderReader {
public:
    HeaderReader(const std::string& path, std::uint64_t size)
        : path_(path), size_(size), file_(path, std::ios::binary) {}

    NetcdfHeader read() {
        if (!file_) throw Error(ExitCode::input_output, path_ + ": cannot read: " + std::strerror(errno));
        std::array<char, 4> magic{};
        file_.read(magic.data(), magic.size());
        const bool classic = file_ && std::string_view(magic.data(), 3) == "CDF";
        if (!classic || (magic[3] != 1 && magic[3] != 2 && magic[3] != 5)) refuse_kind();
        wide_offsets_ = magic[3] != 1, wide_counts_ = magic[3] == 5;
        header_.records = count();
        read_dimensions();
        header_.attributes = attributes();
        read_variables();
        check_records();
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ExitCode::bad_file, path_ + ": expected a netCDF file of results (results.nc): " + why);
    }
    [[noreturn]] void refuse_kind() const {
        const bool csv = std::filesystem::path(path_).extension() == ".csv";
        fail(csv ? "a table of text has no units and no picture"
                 : "this is no netCDF classic file; hamilcar writes and reads that format alone");
    }

    std::uint64_t number(int bytes) {
        std::array<unsigned char, 8> raw{};
        file_.read(reinterpret_cast<char*>(raw.data()), bytes);
        if (!file_) fail("its header is cut off");
        std::uint64_t value = 0;
        for (int i = 0; i < bytes; ++i) value = value << 8 | raw[static_cast<std::size_t>(i)];
        return value;
    }
    std::uint64_t count() { return number(wide_counts_ ? 8 : 4); }
    // Of a list, whose every entry takes a few bytes of the header.
    std::uint64_t length(std::uint64_t tag) {
        const std::uint64_t found = number(4), entries = count();
        if ((found != tag && found != 0) || (found == 0 && entries != 0) || entries > size_)
            fail("its header is damaged");
        return entries;
    }
    void expect_further(std::uint64_t bytes) {
        const auto here = file_.tellg();
        if (here < 0 || bytes > size_ || static_cast<std::uint64_t>(here) + bytes > size_)
            fail("its header is cut off");
    }
    void skip(std::uint64_t bytes) {
        expect_further(bytes);
        file_.seekg(static_cast<std::streamoff>(netcdf_padded(bytes)), std::ios::cur);
        if (!file_ || static_cast<std::uint64_t>(file_.tellg()) > size_) fail("its header is cut off");
    }
    std::string text(std::uint64_t bytes) {
        expect_further(bytes);
        std::string out(bytes, '\0');
        file_.read(out.data(), static_cast<std::streamsize>(bytes));
        file_.seekg(static_cast<std::streamoff>(netcdf_padded(bytes) - bytes), std::ios::cur);
        return out;
    }
    NetcdfType type() {
        const std::uint64_t type = number(4);
        if (type == 0 || type >= type_sizes.size()) fail("its header is damaged");
        return static_cast<NetcdfType>(type);
    }

    void read_dimensions() {
        for (std::uint64_t left = length(netcdf_dimension_tag); left > 0; --left) {
            std::string name = text(count());
            header_.dimensions.push_back({std::move(name), count()});
        }
    }
    std::vector<NetcdfAttribute> attributes() {
        std::vector<NetcdfAttribute> out;
        for (std::uint64_t left = length(netcdf_attribute_tag); left > 0; --left) {
            std::string name = text(count());
            const NetcdfType kind = type();
            const std::uint64_t values = count();
            if (values > size_) fail("its header is cut off");
            if (kind == NetcdfType::character) {
                out.push_back({std::move(name), text(values)});
            } else {
                skip(values * type_sizes[static_cast<std::size_t>(kind)]);
            }
        }
        return out;
    }

    void read_variables() {
        for (std::uint64_t left = length(netcdf_variable_tag); left > 0; --left) {
            NetcdfVariable variable{.name = text(count())};
            read_shape(variable);
            variable.attributes = attributes();
            variable.type = type();
            count();  // its own idea of its size
            variable.begin = number(wide_offsets_ ? 8 : 4);
            add(variable);
            header_.variables.push_back(std::move(variable));
        }
    }
    void read_shape(NetcdfVariable& variable) {
        double values = 1;
        const std::uint64_t rank = count();
        if (rank > max_rank) fail("its header is damaged");
        for (std::uint64_t i = 0; i < rank; ++i) {
            const std::uint64_t dimension = count();
            if (dimension >= header_.dimensions.size()) fail("its header is damaged");
            variable.dimensions.push_back(dimension);
            const std::uint64_t length = header_.dimensions[dimension].length;
            if (length == 0) {
                if (i != 0) fail("its header is damaged: records are a variable's first dimension");
                variable.over_records = true;
            } else {
                values *= static_cast<double>(length);
            }
        }
        if (!(values < max_values)) fail("its header asks for more than the file holds");
        variable.values = static_cast<std::uint64_t>(values);
    }
    void add(const NetcdfVariable& variable) {
        const bool empty = variable.over_records && header_.records == 0;
        if (empty) return;
        const std::uint64_t bytes = variable.bytes();
        const std::uint64_t last = variable.over_records ? farthest : size_ + netcdf_padding;
        if (variable.begin > last || bytes > size_ + netcdf_padding)
            fail("its header asks for more than the file holds");
        if (variable.over_records) {
            // Records of one variable alone stand without padding between them.
            header_.record_size =
                header_.record_size == 0 ? bytes : netcdf_padded(header_.record_size) + netcdf_padded(bytes);
            first_record_ = std::min(first_record_, variable.begin);
            end_of_first_record_ = std::max(end_of_first_record_, variable.begin + bytes);
        } else {
            fixed_ += netcdf_padded(bytes), end_of_fixed_ = std::max(end_of_fixed_, variable.begin + bytes);
        }
    }
    void check_records() const {
        const auto record = static_cast<double>(header_.record_size), records = static_cast<double>(header_.records);
        const double held = static_cast<double>(fixed_) + records * record;
        const double end = static_cast<double>(end_of_first_record_) + std::max(records - 1, 0.0) * record;
        const auto size = static_cast<double>(size_);
        if (held > size + netcdf_padding || std::max(end, static_cast<double>(end_of_fixed_)) > size) {
            fail(
                fmt::format("its header tells of {} records, more than the file of {} bytes holds: it is cut off or "
                            "damaged",
                            header_.records, size_));
        }
        if (end_of_first_record_ > 0 && end_of_first_record_ - first_record_ > header_.record_size)
            fail("its header is damaged");
    }

    const std::string& path_;
    std::uint64_t size_;  // of the file [byte]
    std::ifstream file_;
    bool wide_offsets_ = false, wide_counts_ = false;
    NetcdfHeader header_;
    std::uint64_t fixed_ = 0, end_of_fixed_ = 0, first_record_ = ~std::uint64_t{0}, end_of_first_record_ = 0;  // [byte]
};

}  // namespace

std::string NetcdfVariable::text(std::string_view attribute) const {
    return text_of(attributes, attribute);
}
std::uint64_t NetcdfVariable::bytes() const {
    return values * type_sizes[static_cast<std::size_t>(type)];
}
std::string NetcdfHeader::text(std::string_view attribute) const {
    return text_of(attributes, attribute);
}
std::optional<std::size_t> NetcdfHeader::dimension(std::string_view name) const {
    return index_of(dimensions, name);
}
std::optional<std::size_t> NetcdfHeader::variable(std::string_view name) const {
    return index_of(variables, name);
}
std::uint64_t NetcdfHeader::length(std::size_t dimension) const {
    return dimensions[dimension].length == 0 ? records : dimensions[dimension].length;
}
std::vector<std::uint64_t> NetcdfHeader::shape(const NetcdfVariable& variable) const {
    std::vector<std::uint64_t> out;
    for (const std::size_t dimension : variable.dimensions) out.push_back(length(dimension));
    return out;
}

NetcdfHeader read_netcdf_header(const std::string& path) {
    return HeaderReader(path, regular_file_size(path)).read();
}

}  // namespace hamilcar::io
