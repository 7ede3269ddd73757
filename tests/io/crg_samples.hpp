// An OpenCRG file by hand that several tests change.
#pragma once

#include <string>

#include "hamilcar/io/crg_file.hpp"

namespace hamilcar::io {

// In the manner of OpenCRG's handmade samples: hardly a key, sections by number about the middle.
inline const std::string minimal_crg = R"($CT                                                 ! comment text block
A road of two meters by three
$
$!**********************************************************************
$ROAD_CRG                                           ! road parameters
REFERENCE_LINE_INCREMENT = 1.0
LONG_SECTION_V_INCREMENT = 0.50
LONG_SECTION_V_RIGHT = -1
$
* a remark between sections
$KD_Definition                                      ! data definition
#:LRFI                                              ! for people
D:long section 1,m
D:long section 2,m
* and one within
D:long section 3,m
D:long section 4,m
D:long section 5,m
$
$$$$!****10********20********30********40********50********60********70
 0.0000000 0.0000000 0.0000000 0.0000000 0.0000000
 0.0000000 0.0111111 0.0222222-0.0111111 0.0000000
 0.0111111 0.0000000 0.0000000 *missing* *missing*
 0.0000000 0.0000000 0.0000000 0.0000000 0.1000000
)";

inline CrgDescription parsed_crg(const std::string& text) {
    return parse_crg(text, "road.crg");
}

}  // namespace hamilcar::io
