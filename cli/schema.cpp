// `hamilcar schema vehicle|scenario`: what an editor needs to complete and check such files.
#include "hamilcar/io/schema.hpp"

#include <fmt/format.h>

#include "commands.hpp"

namespace hamilcar::cli {

io::ExitCode schema(const Options& options) {
    const std::string text = options.file == "vehicle" ? io::vehicle_schema() : io::scenario_schema();
    if (options.output.empty()) {
        fmt::print("{}", text);
    } else {
        write_file(options.output, text);
    }
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
