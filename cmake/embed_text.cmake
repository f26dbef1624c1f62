# cmake -DOUT=file.cpp -DROOT=dir "-DFILES=a.glsl|b.frag" -P embed_text.cmake
# Writes one table of file name -> text, so that the programs carry their shaders.
string(REPLACE "|" ";" FILES "${FILES}")
set(text "#include \"render/shaders/shader_text.h\"\n\nnamespace skyig::render::shaders {\n\n")
string(APPEND text "std::optional<std::string_view> shader_text(std::string_view path) noexcept {\n")
foreach(file ${FILES})
  file(READ "${ROOT}/${file}" content)
  string(APPEND text "    if (path == \"${file}\") return std::string_view(R\"shader(${content})shader\");\n")
endforeach()
string(APPEND text "    return std::nullopt;\n}\n\n}  // namespace skyig::render::shaders\n")
file(WRITE "${OUT}" "${text}")
