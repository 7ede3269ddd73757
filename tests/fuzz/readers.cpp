#include "fuzz/readers.hpp"

#include "fuzz/file_targets.hpp"
#include "fuzz/link_targets.hpp"

namespace hamilcar::fuzz {

std::span<const Reader> readers() {
    static constexpr Reader all[] = {
        {"checkpoint", run_checkpoint}, {"columns", run_columns}, {"crg", run_crg},         {"grid", run_grid},
        {"message", run_message},       {"netcdf", run_netcdf},   {"outcome", run_outcome}, {"request", run_request},
        {"scenario", run_scenario},     {"scene", run_scene},     {"study", run_study},     {"tir", run_tir},
        {"vehicle", run_vehicle},
    };
    return all;
}

}  // namespace hamilcar::fuzz
