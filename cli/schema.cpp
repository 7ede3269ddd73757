// `hamilcar schema vehicle|scenario`: what an editor needs to complete and check such files.
#include "hamilcar/io/schema.hpp"

#include "commands.hpp"
#include "files.hpp"

namespace hamilcar::cli {

namespace {

struct SchemaOptions {
    std::string kind, output;
};

io::ExitCode schema(const SchemaOptions& options) {
    print_or_write(options.output, options.kind == "vehicle" ? io::vehicle_schema() : io::scenario_schema());
    return io::ExitCode::ok;
}

}  // namespace

void add_schema(CommandList& list) {
    auto [command, o] =
        list.add<SchemaOptions>("schema", "print the JSON Schema of vehicle or scenario files, for editors", schema);
    command.add("kind", o.kind, "vehicle or scenario").required().one_of({"vehicle", "scenario"});
    command.add("-o,--output", o.output, "file for the schema, instead of standard output");
}

}  // namespace hamilcar::cli
