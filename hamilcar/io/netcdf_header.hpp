// What a netCDF classic file says of itself: dimensions, attributes, variables, and where their numbers stand.
//
// Format: "NetCDF Classic Format Specification" (Unidata, netCDF 4 documentation, appendix B). Everything is big-endian and
// padded to four bytes:
//
//     magic, records, dimensions, attributes, variables: name, dimension numbers, attributes, type, size, begin
//
// then the variables of fixed size, one after the other, then the records: a value of each variable over the unlimited
// dimension, side by side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hamilcar::io {

// As the format numbers them.
enum class NetcdfType : std::uint32_t {
    byte = 1,
    character,
    short_integer,
    integer,
    single_number,
    number,
    unsigned_byte,  // from here on of the fifth version alone
    unsigned_short,
    unsigned_integer,
    long_integer,
    unsigned_long
};

inline constexpr std::uint64_t netcdf_padding = 3;  // that may follow a value, or lack behind the last one [byte]
constexpr std::uint64_t netcdf_padded(std::uint64_t bytes) {
    return (bytes + netcdf_padding) / 4 * 4;
}
// In front of a list.
inline constexpr std::uint32_t netcdf_dimension_tag = 0x0A, netcdf_variable_tag = 0x0B, netcdf_attribute_tag = 0x0C;

struct NetcdfDimension {
    std::string name;
    std::uint64_t length = 0;  // 0: unlimited, the records
};

struct NetcdfAttribute {
    std::string name, text;
};

struct NetcdfVariable {
    std::string name;
    NetcdfType type = NetcdfType::number;
    std::vector<std::size_t> dimensions;      // by their numbers
    std::vector<NetcdfAttribute> attributes;  // those that are text
    std::uint64_t begin = 0;                  // in the file; of the first record [byte]
    std::uint64_t values = 1;                 // of all its dimensions but the unlimited one
    bool over_records = false;

    std::string text(std::string_view attribute) const;  // empty where there is none
    std::uint64_t bytes() const;                         // of its values, without padding
};

struct NetcdfHeader {
    std::uint64_t records = 0;
    std::vector<NetcdfDimension> dimensions;
    std::vector<NetcdfAttribute> attributes;
    std::vector<NetcdfVariable> variables;
    std::uint64_t record_size = 0;  // [byte]

    std::string text(std::string_view attribute) const;
    std::optional<std::size_t> dimension(std::string_view name) const;
    std::optional<std::size_t> variable(std::string_view name) const;
    // Of a dimension, the unlimited one too.
    std::uint64_t length(std::size_t dimension) const;
    std::vector<std::uint64_t> shape(const NetcdfVariable& variable) const;
};

// All that the header says fits into the file: every value that it tells of is there; padding may lack. Throws
// Error: input_output for what cannot be read, bad_file for what is no netCDF classic file (its first bytes are "CDF" and 1, 2
// or 5; a netCDF-4 file is HDF5, which hamilcar neither reads nor writes), or one whose header is damaged or
// asks for more data than the file has.
NetcdfHeader read_netcdf_header(const std::string& path);

// The header of a new file with 64-bit offsets ("CDF" 2), and no records yet. Sets where its variables begin and what they hold.
// Throws Error(input_output) for names that the format does not have, with `path` in front.
std::string lay_out_netcdf(NetcdfHeader& header, const std::string& path);

// Where the number of records stands [byte].
inline constexpr long netcdf_records_place = 4;

// Numbers as the format has them, the first byte the largest.
template <class Number>
void append_big_endian(std::string& to, Number number);
extern template void append_big_endian(std::string&, double);
extern template void append_big_endian(std::string&, float);
extern template void append_big_endian(std::string&, std::int32_t);
extern template void append_big_endian(std::string&, std::uint32_t);
extern template void append_big_endian(std::string&, std::uint64_t);

}  // namespace hamilcar::io
