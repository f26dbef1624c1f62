skyig_compile_alone(flightgear_input.cpp recorder.cpp)
# The frame loop (no GL) and the daemon (GL).
skyig_library(server_loop
  SOURCES answers.cpp bus_input.cpp display_pace.cpp flightgear_input.cpp frame_hashes.cpp frame_loop.cpp frame_pacer.cpp frame_status.cpp frame_table.cpp from_config.cpp host_timing.cpp image_writer.cpp inbox.cpp live_settings.cpp live_wire.cpp lock_step.cpp overlay_text.cpp overload.cpp recorder.cpp replay.cpp
          stop_signal.cpp
  DEPS server server_report server_service server_status server_world server_ephemeris config protocol_canaerospace protocol_cigi protocol_flightgear protocol_recording protocol_transport render_overlay render_scene fmt::fmt
       Threads::Threads)
target_compile_definitions(server_loop PUBLIC SKYIG_VERSION="${PROJECT_VERSION}")
add_subdirectory(rig)

if(SKYIG_GL)
  skyig_library(server_painter SOURCES gl_painter.cpp gl_seat.cpp light_files.cpp window_layouts.cpp DEPS server_loop render render_desktop render_gl
                PRIVATE_DEPS render_output)
  add_executable(skyigd main.cpp daemon.cpp outside.cpp rig_part.cpp)
  skyig_compile_together(skyigd)
  target_link_libraries(skyigd PRIVATE skyig_build server_painter server_rig render_output config_reference)
endif()
