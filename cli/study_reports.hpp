// A study's points driven once more, each run into a folder of its own with its report.
#pragma once

#include <string>
#include <vector>

#include "hamilcar/study/study_table.hpp"

namespace hamilcar::cli {

// The points that were asked for, "3", "best" or "all", from 0 on. Throws io::Error(usage) for what is none of them.
std::vector<std::size_t> points_called(const std::vector<std::string>& words, const StudyTable& table);

// Drives all runs of a point that are no analyses, unless interrupted. Errors are of that run alone, and told.
void write_reports(const StudyDescription& study, const StudyTable& table, std::size_t point,
                   const std::string& folder);

// Those of an earlier study in this folder would be taken for this one's.
void remove_reports(const StudyTable& table, const std::string& folder);

// Those that stand in the study's folder, by point and run, by their paths from there; "" where there is none.
std::vector<std::vector<std::string>> reports_in(const std::string& folder, const StudyTable& table);

}  // namespace hamilcar::cli
