# cmake -DOUT=file.cpp -DROOT=dir "-DFILES=a.glsl|b.frag" -DHEADER=a/b.h -DNAMESPACE=a::b -DFUNCTION=text_of
#   -P embed_text.cmake
# Writes one table of file name -> text, so that the programs carry their shaders and presets.
string(REPLACE "|" ";" FILES "${FILES}")
set(text "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n")
string(APPEND text "std::optional<std::string_view> ${FUNCTION}(std::string_view path) noexcept {\n")
foreach(file ${FILES})
  file(READ "${ROOT}/${file}" content)
  string(APPEND text "    if (path == \"${file}\") return std::string_view(R\"embedded(${content})embedded\");\n")
endforeach()
string(APPEND text "    return std::nullopt;\n}\n\n}  // namespace ${NAMESPACE}\n")
file(WRITE "${OUT}" "${text}")
