// The header of a new netCDF file: its text, with where each variable will stand.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <string_view>
#include <type_traits>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/netcdf_header.hpp"

namespace hamilcar::io {

template <class Number>
void append_big_endian(std::string& to, Number number) {
    using Bits = std::conditional_t<sizeof(Number) == 8, std::uint64_t, std::uint32_t>;
    const auto bits = std::bit_cast<Bits>(number);
    for (int shift = 8 * static_cast<int>(sizeof(Bits)) - 8; shift >= 0; shift -= 8) {
        to += static_cast<char>(bits >> shift & 0xff);
    }
}
template void append_big_endian(std::string&, double);
template void append_big_endian(std::string&, float);
template void append_big_endian(std::string&, std::int32_t);
template void append_big_endian(std::string&, std::uint32_t);
template void append_big_endian(std::string&, std::uint64_t);

namespace {

void append_tag(std::string& to, std::uint64_t tag, std::size_t entries) {
    append_big_endian(to, static_cast<std::uint32_t>(entries == 0 ? 0 : tag));
    append_big_endian(to, static_cast<std::uint32_t>(entries));
}
void append_text(std::string& to, std::string_view text) {
    append_big_endian(to, static_cast<std::uint32_t>(text.size()));
    to += text;
    to.append(netcdf_padded(text.size()) - text.size(), '\0');
}
void append_attributes(std::string& to, const std::vector<NetcdfAttribute>& attributes) {
    append_tag(to, netcdf_attribute_tag, attributes.size());
    for (const NetcdfAttribute& attribute : attributes) {
        append_text(to, attribute.name);
        append_big_endian(to, static_cast<std::uint32_t>(NetcdfType::character));
        append_text(to, attribute.text);
    }
}

std::string header_text(const NetcdfHeader& header) {
    std::string out = "CDF\x02";
    append_big_endian(out, static_cast<std::uint32_t>(header.records));
    append_tag(out, netcdf_dimension_tag, header.dimensions.size());
    for (const NetcdfDimension& dimension : header.dimensions) {
        append_text(out, dimension.name);
        append_big_endian(out, static_cast<std::uint32_t>(dimension.length));
    }
    append_attributes(out, header.attributes);
    append_tag(out, netcdf_variable_tag, header.variables.size());
    for (const NetcdfVariable& variable : header.variables) {
        append_text(out, variable.name);
        append_big_endian(out, static_cast<std::uint32_t>(variable.dimensions.size()));
        for (const std::size_t dimension : variable.dimensions)
            append_big_endian(out, static_cast<std::uint32_t>(dimension));
        append_attributes(out, variable.attributes);
        append_big_endian(out, static_cast<std::uint32_t>(variable.type));
        append_big_endian(out, static_cast<std::uint32_t>(netcdf_padded(variable.bytes())));
        append_big_endian(out, variable.begin);
    }
    return out;
}

void expect_name(const std::string& name, const std::string& path) {
    const auto refused = [](char c) { return c == '/' || (c >= 0 && c < ' ') || c == 0x7f; };
    if (!name.empty() && name.back() != ' ' && std::ranges::none_of(name, refused)) return;
    throw Error(ExitCode::input_output,
                fmt::format("{}: cannot define {}: a name in a netCDF file is not empty, without '/' and control "
                            "characters, and does not end in a space",
                            path, name));
}

}  // namespace

std::string lay_out_netcdf(NetcdfHeader& header, const std::string& path) {
    header.records = header.record_size = 0;
    for (NetcdfVariable& variable : header.variables) {
        expect_name(variable.name, path);
        if (&header.variables[*header.variable(variable.name)] != &variable) {
            throw Error(ExitCode::input_output,
                        fmt::format("{}: cannot define {}: another has this name", path, variable.name));
        }
        variable.values = 1, variable.over_records = false;
        for (const std::size_t dimension : variable.dimensions) {
            const std::uint64_t length = header.dimensions[dimension].length;
            length == 0 ? variable.over_records = true : (variable.values *= length, true);
        }
        if (variable.over_records) header.record_size += netcdf_padded(variable.bytes());
    }
    std::uint64_t begin = header_text(header).size();  // whatever the numbers in it, its length is the same
    for (const bool over_records : {false, true}) {
        for (NetcdfVariable& variable : header.variables) {
            if (variable.over_records != over_records) continue;
            variable.begin = begin;
            begin += netcdf_padded(variable.bytes());
        }
    }
    return header_text(header);
}

}  // namespace hamilcar::io
