# Installs the programs into bin and everything else below share/shorebreak.
include(GNUInstallDirs)
set(share ${CMAKE_INSTALL_DATADIR}/shorebreak)

foreach(program shorebreak shorebreak-live shorebreak-make-plant shorebreak-monitor shorebreak-control)
    if(TARGET ${program})
        install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    endif()
endforeach()
# Scenes refer to their meshes by relative paths, so the two folders stay next to each other.
install(DIRECTORY assets/scenes assets/meshes DESTINATION ${share})
install(DIRECTORY lcmtypes DESTINATION ${share} FILES_MATCHING PATTERN "*.lcm")
install(FILES tools/examples/subscriber.c DESTINATION ${share}/examples)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL FILES_MATCHING PATTERN "*.md"
        PATTERN "*.png")
foreach(file README.md CHANGELOG.md LICENSE CITATION.cff)
    install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DOCDIR} OPTIONAL)
endforeach()
