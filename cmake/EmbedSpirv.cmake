# Writes a SPIR-V binary as a C++ array of 32-bit words. Script mode: INPUT, OUTPUT, HEADER, VARIANT (the
# variable) and NAME (what its timings are called).
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
string(REGEX REPLACE "((0x........,)(0x........,)(0x........,)(0x........,)(0x........,)(0x........,)(0x........,)(0x........,))" "\\1\n" words "${words}")
file(WRITE ${OUTPUT}
  "#include \"${HEADER}\"\n\nnamespace {\nconst std::uint32_t words[] = {\n${words}\n};\n}  // namespace\n\nnamespace ppm::shaders {\nconst ppm::gpu::Shader ${VARIANT}{\"${NAME}\", words};\n}  // namespace ppm::shaders\n")
