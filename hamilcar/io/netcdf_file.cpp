#include "hamilcar/io/netcdf_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "hamilcar/io/error.hpp"
#include "hamilcar/io/whole_file.hpp"

namespace hamilcar::io {

namespace {

constexpr std::size_t output_buffer = std::size_t{1} << 18;  // [byte]
constexpr std::size_t records_per_block = 1024;

template <class Bits>
Bits bits_at(const char* from) {
    Bits bits = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
        bits = static_cast<Bits>(static_cast<Bits>(bits << 7 << 1) | static_cast<unsigned char>(from[i]));
    }
    return bits;
}
template <class Number, class Bits>
double number_as(const char* from) {
    return static_cast<double>(std::bit_cast<Number>(bits_at<Bits>(from)));
}

double number_at(const char* from, NetcdfType type) {
    switch (type) {
        case NetcdfType::byte: return number_as<std::int8_t, std::uint8_t>(from);
        case NetcdfType::short_integer: return number_as<std::int16_t, std::uint16_t>(from);
        case NetcdfType::integer: return number_as<std::int32_t, std::uint32_t>(from);
        case NetcdfType::single_number: return number_as<float, std::uint32_t>(from);
        case NetcdfType::number: return number_as<double, std::uint64_t>(from);
        case NetcdfType::character:
        case NetcdfType::unsigned_byte: return number_as<std::uint8_t, std::uint8_t>(from);
        case NetcdfType::unsigned_short: return number_as<std::uint16_t, std::uint16_t>(from);
        case NetcdfType::unsigned_integer: return number_as<std::uint32_t, std::uint32_t>(from);
        case NetcdfType::long_integer: return number_as<std::int64_t, std::uint64_t>(from);
        case NetcdfType::unsigned_long: return number_as<std::uint64_t, std::uint64_t>(from);
    }
    return 0;
}

}  // namespace

NetcdfReader::NetcdfReader(const std::string& path)
    : path_(path), header_(read_netcdf_header(path)), file_(path, std::ios::binary) {
    if (!file_) throw Error(ExitCode::input_output, path_ + ": cannot read: " + std::strerror(errno));
}

std::string NetcdfReader::bytes(std::uint64_t begin, std::uint64_t count) {
    std::string out(count, '\0');
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(begin));
    file_.read(out.data(), static_cast<std::streamsize>(count));
    if (static_cast<std::uint64_t>(file_.gcount()) < count) {
        throw Error(ExitCode::input_output, path_ + ": cannot read: it was cut off while it was read");
    }
    return out;
}

std::vector<double> NetcdfReader::numbers(const NetcdfVariable& variable) {
    std::vector<double> out;
    const std::uint64_t width = variable.bytes() / std::max<std::uint64_t>(variable.values, 1);
    const std::uint64_t records = variable.over_records ? header_.records : 1;
    out.reserve(records * variable.values);
    for (std::uint64_t record = 0; record < records; ++record) {
        const std::string raw = bytes(variable.begin + record * header_.record_size, variable.bytes());
        for (std::uint64_t i = 0; i < variable.values; ++i)
            out.push_back(number_at(raw.data() + i * width, variable.type));
    }
    return out;
}

// Records in blocks: in the file all variables of a record stand side by side.
std::vector<std::vector<double>> NetcdfReader::series(std::span<const std::size_t> variables) {
    std::vector<std::vector<double>> out;
    std::vector<std::pair<std::size_t, const NetcdfVariable*>> over_records;
    std::uint64_t first = ~std::uint64_t{0};
    for (const std::size_t number : variables) {
        const NetcdfVariable& variable = header_.variables[number];
        if (variable.over_records) {
            over_records.emplace_back(out.size(), &variable);
            first = std::min(first, variable.begin);
            out.emplace_back(header_.records);
        } else {
            out.push_back(numbers(variable));
        }
    }
    if (over_records.empty()) return out;
    for (std::uint64_t row = 0; row < header_.records; row += records_per_block) {
        const std::uint64_t rows = std::min<std::uint64_t>(records_per_block, header_.records - row);
        std::uint64_t end = 0;
        for (const auto& [column, variable] : over_records) end = std::max(end, variable->begin + variable->bytes());
        const std::string raw =
            bytes(first + row * header_.record_size, (rows - 1) * header_.record_size + (end - first));
        for (const auto& [column, variable] : over_records) {
            const char* from = raw.data() + (variable->begin - first);
            for (std::uint64_t i = 0; i < rows; ++i, from += header_.record_size) {
                out[column][row + i] = number_at(from, variable->type);
            }
        }
    }
    return out;
}

NetcdfOutput::NetcdfOutput(const std::string& path, NetcdfHeader header) : path_(path) {
    const std::string text = lay_out_netcdf(header, path);
    expect_writable_place(path);
    file_.reset(std::fopen(path.c_str(), "wbe"));
    if (!file_) fail("open for writing");
    std::setvbuf(file_.get(), nullptr, _IOFBF, output_buffer);
    try {
        write(text, "write the header");
        flush(0, "write the header");
    } catch (const Error&) {
        std::error_code gone_already;
        std::filesystem::remove(path, gone_already);
        throw;
    }
}

void NetcdfOutput::write(std::string_view bytes, std::string_view action) {
    if (!file_) throw Error(ExitCode::input_output, fmt::format("{}: cannot {}: it was closed", path_, action));
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail(action);
}

// First the records, then their number: a program that is killed in between leaves the file as it was.
void NetcdfOutput::flush(std::uint64_t records, std::string_view action) {
    if (!file_) throw Error(ExitCode::input_output, fmt::format("{}: cannot {}: it was closed", path_, action));
    if (std::fflush(file_.get()) != 0) fail(action);
    std::string count;
    append_big_endian(count, static_cast<std::uint32_t>(records));
    if (std::fseek(file_.get(), netcdf_records_place, SEEK_SET) != 0) fail(action);
    write(count, action);
    if (std::fflush(file_.get()) != 0 || std::fseek(file_.get(), 0, SEEK_END) != 0) fail(action);
}

void NetcdfOutput::close() {
    if (std::fclose(file_.release()) != 0) fail("close");
}

void NetcdfOutput::fail(std::string_view action) {
    const int cause = errno;
    file_.reset();
    throw Error(ExitCode::input_output, fmt::format("{}: cannot {}: {}", path_, action, std::strerror(cause)));
}

void write_netcdf(const std::string& path, const NetcdfHeader& header, std::string_view bytes) {
    const std::string beside = create_beside(path);
    try {
        NetcdfOutput file(beside, header);
        file.write(bytes, "write");
        file.close();
    } catch (const Error&) {
        std::error_code gone_already;
        std::filesystem::remove(beside, gone_already);
        throw;
    }
    put_in_place(beside, path);
}

}  // namespace hamilcar::io
