// `hamilcar schema vehicle|scenario`: what an editor needs to complete and check such files.
#include "hamilcar/io/schema.hpp"

#include "commands.hpp"

namespace hamilcar::cli {

io::ExitCode schema(const Options& options) {
    const std::string text = options.file == "vehicle" ? io::vehicle_schema() : io::scenario_schema();
    print_or_write(options.output, text);
    return io::ExitCode::ok;
}

}  // namespace hamilcar::cli
