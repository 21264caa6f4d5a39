# Writes OUT, a C file with one text: a hash of the sources below ROOT/src that determine results, and HOW they are
# compiled. It runs at build time. An unchanged file is not written again.
cmake_minimum_required(VERSION 3.25)
set(sources "")
foreach(folder base/vec.h base/random.h base/exact.h base/exact.c base/sets.h base/multiversion.h physics offshore geometry
        sea sim measure)
    if(folder MATCHES "\\.[ch]$")
        list(APPEND sources src/${folder})
    else()
        file(GLOB_RECURSE found RELATIVE ${ROOT} ${ROOT}/src/${folder}/*.c ${ROOT}/src/${folder}/*.h
             ${ROOT}/src/${folder}/CMakeLists.txt)
        list(APPEND sources ${found})
    endif()
endforeach()
list(SORT sources)
set(all "")
foreach(source ${sources})
    file(SHA256 ${ROOT}/${source} hash)
    string(APPEND all "${source} ${hash}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)
string(REGEX REPLACE "[\\\\\"]" "" HOW "${HOW}")
file(CONFIGURE OUTPUT ${OUT} CONTENT
     "extern const char sb_build_sources[];\nconst char sb_build_sources[] = \"sources @hash@, @HOW@\";\n" @ONLY)
