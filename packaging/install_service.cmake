# The daemon's settings and units. With the prefix /usr they are the system's own, in /etc; elsewhere they are under the
# prefix, and the units name what is there. Settings that are there already stay. DESTDIR goes before all.
if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(etc /etc)
else()
  set(etc ${CMAKE_INSTALL_PREFIX}/etc)
endif()

if(NOT EXISTS "$ENV{DESTDIR}${etc}/skyig/site.toml")
  file(INSTALL DESTINATION ${etc}/skyig TYPE FILE FILES ${skyig_source}/config/examples/one-channel.toml
    RENAME site.toml)
endif()

file(GLOB units ${skyig_source}/packaging/*.service)
foreach(unit ${units})
  file(READ ${unit} text)
  string(REPLACE "/usr/bin/" "${CMAKE_INSTALL_PREFIX}/bin/" text "${text}")
  string(REPLACE "/etc/skyig/" "${etc}/skyig/" text "${text}")
  get_filename_component(name ${unit} NAME)
  file(WRITE ${skyig_scratch}/${name} "${text}")
  file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/lib/systemd/system TYPE FILE FILES ${skyig_scratch}/${name})
endforeach()

if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  execute_process(COMMAND gzip -9nc ${skyig_source}/packaging/deb/changelog
    OUTPUT_FILE ${skyig_scratch}/changelog.Debian.gz COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL DESTINATION /usr/share/doc/skyig TYPE FILE FILES ${skyig_scratch}/changelog.Debian.gz)
endif()
