// Format: "NetCDF Classic Format Specification" (Unidata, netCDF 4 documentation, appendix B). Everything is big-endian and
// padded to four bytes:
//
//     magic, records, dimensions, attributes, variables: name, dimension numbers, attributes, type, size, begin
//
// Sizes are recomputed from the dimensions, as the library does. What the variables hold in all must fit into the file:
// variables that share their bytes would make a small file a large memory.
#include "hamilcar/io/netcdf_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::uint64_t dimension_tag = 0x0A, variable_tag = 0x0B, attribute_tag = 0x0C;
constexpr std::array<std::uint64_t, 12> type_sizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};  // [byte]
constexpr std::uint64_t padding = 3;            // that the last value may lack [byte]
constexpr std::uint64_t max_dimensions = 1024;  // of a variable; the library has no more
constexpr double max_values = 1e18;             // beyond any file, within 64 bits

class HeaderReader {
public:
    HeaderReader(const std::string& path, std::uint64_t size)
        : path_(path), size_(size), file_(path, std::ios::binary) {}

    void check() {
        if (!file_) throw Error(ExitCode::input_output, path_ + ": cannot read: " + std::strerror(errno));
        std::array<char, 4> magic{};
        file_.read(magic.data(), magic.size());
        const bool classic = file_ && std::string_view(magic.data(), 3) == "CDF";
        if (!classic || (magic[3] != 1 && magic[3] != 2 && magic[3] != 5)) refuse_kind();
        wide_offsets_ = magic[3] != 1, wide_counts_ = magic[3] == 5;
        records_ = count();
        read_dimensions();
        skip_attributes();
        read_variables();
        const double record = static_cast<double>(record_size_);
        const double held = static_cast<double>(fixed_) + static_cast<double>(records_) * record;
        const double behind_first = records_ > 0 ? static_cast<double>(records_ - 1) * record : 0;
        const double end = static_cast<double>(end_of_first_record_) + behind_first;
        if (std::max({held, end, static_cast<double>(end_of_fixed_)}) > static_cast<double>(size_ + padding)) {
            fail(
                fmt::format("its header tells of {} records, more than the file of {} bytes holds: it is cut off or "
                            "damaged",
                            records_, size_));
        }
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
    void skip(std::uint64_t bytes) {
        if (bytes > size_) fail("its header is cut off");
        file_.seekg(static_cast<std::streamoff>((bytes + padding) / 4 * 4), std::ios::cur);
        if (!file_ || static_cast<std::uint64_t>(file_.tellg()) > size_) fail("its header is cut off");
    }
    std::uint64_t type_size() {
        const std::uint64_t type = number(4);
        if (type == 0 || type >= type_sizes.size()) fail("its header is damaged");
        return type_sizes[type];
    }

    void read_dimensions() {
        for (std::uint64_t left = length(dimension_tag); left > 0; --left) {
            skip(count());
            dimensions_.push_back(count());  // 0: the records
        }
    }
    void skip_attributes() {
        for (std::uint64_t left = length(attribute_tag); left > 0; --left) {
            skip(count());
            const std::uint64_t width = type_size(), values = count();
            if (values > size_) fail("its header is cut off");
            skip(values * width);
        }
    }

    void read_variables() {
        for (std::uint64_t left = length(variable_tag); left > 0; --left) {
            skip(count());
            bool over_records = false;
            double values = 1;
            const std::uint64_t rank = count();
            if (rank > max_dimensions) fail("its header is damaged");
            for (std::uint64_t i = 0; i < rank; ++i) {
                const std::uint64_t dimension = count();
                if (dimension >= dimensions_.size()) fail("its header is damaged");
                if (dimensions_[dimension] == 0) {
                    over_records = true;
                } else {
                    values *= static_cast<double>(dimensions_[dimension]);
                }
            }
            skip_attributes();
            const std::uint64_t width = type_size();
            count();  // its own idea of its size
            const std::uint64_t begin = number(wide_offsets_ ? 8 : 4);
            if (!(values < max_values) || (!over_records && begin > size_ + padding))
                fail("its header asks for more than the file holds");
            add(static_cast<std::uint64_t>(values) * width, begin, over_records);
        }
    }
    void add(std::uint64_t bytes, std::uint64_t begin, bool over_records) {
        const std::uint64_t padded = (bytes + padding) / 4 * 4;
        if (over_records && records_ == 0) return;
        if (bytes > size_ + padding) fail("its header asks for more than the file holds");
        if (over_records) {
            // Records of one variable alone stand without padding between them.
            record_size_ = record_size_ == 0 ? bytes : (record_size_ + padding) / 4 * 4 + padded;
            end_of_first_record_ = std::max(end_of_first_record_, begin + bytes);
        } else {
            fixed_ += padded, end_of_fixed_ = std::max(end_of_fixed_, begin + bytes);
        }
    }

    const std::string& path_;
    std::uint64_t size_;  // of the file [byte]
    std::ifstream file_;
    bool wide_offsets_ = false, wide_counts_ = false;
    std::vector<std::uint64_t> dimensions_;
    std::uint64_t records_ = 0;
    std::uint64_t record_size_ = 0, end_of_first_record_ = 0, fixed_ = 0, end_of_fixed_ = 0;  // [byte]
};

}  // namespace

void check_netcdf_header(const std::string& path) {
    HeaderReader(path, regular_file_size(path)).check();
}

}  // namespace hamilcar::io
