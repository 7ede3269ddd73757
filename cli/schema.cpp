// `hamilcar schema vehicle|scenario|study`: what an editor needs to complete and check such files.
#include "hamilcar/io/schema.hpp"
#include "hamilcar/study/study_file.hpp"

#include "commands.hpp"
#include "files.hpp"

namespace hamilcar::cli {

namespace {

struct SchemaOptions {
    std::string kind, output;
};

io::ExitCode schema(const SchemaOptions& options) {
    print_or_write(options.output, options.kind == "vehicle"    ? io::vehicle_schema()
                                   : options.kind == "scenario" ? io::scenario_schema()
                                                                : study_schema());
    return io::ExitCode::ok;
}

}  // namespace

void add_schema(CommandList& list) {
    auto [command, o] = list.add<SchemaOptions>(
        "schema", "print the JSON Schema of vehicle, scenario or study files, for editors", schema);
    command.add("kind", o.kind, "vehicle, scenario or study").required().one_of({"vehicle", "scenario", "study"});
    command.add("-o,--output", o.output, "file for the schema, instead of standard output");
}

}  // namespace hamilcar::cli
