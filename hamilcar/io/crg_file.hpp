// OpenCRG files, the ASCII and the binary forms: a header in clear text, then the rows of the grid.
#pragma once

#include <string>
#include <string_view>

#include "hamilcar/description/crg.hpp"

namespace hamilcar::io {

// The four forms of the rows: in ASCII 10 or 20 characters a number, in binary 4 or 8 bytes, big-endian.
enum class CrgFormat {
    long_ascii_single,  // LRFI
    long_ascii_double,  // LDFI
    binary_single,      // KRBI
    binary_double       // KDBI
};

// Modifiers of the file are applied; missing heights stay NaN. A file may refer to another one that has the data, beside
// it. Mistakes are told with their place, ExitCode::bad_file; what is not used, as a remark of the description.
CrgDescription read_crg(const std::string& path);

// The same of bytes in memory; `name` stands for the path in messages.
CrgDescription parse_crg(std::string_view bytes, const std::string& name);

// Throws std::invalid_argument if the parts of the description do not fit together.
void write_crg(const CrgDescription& d, const std::string& path, CrgFormat format);

}  // namespace hamilcar::io
