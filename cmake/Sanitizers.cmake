# AddressSanitizer and UndefinedBehaviorSanitizer for all targets of the build tree.
option(PPM_SANITIZE "Instrument everything with ASan and UBSan" OFF)

if(PPM_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer -O1)
  add_link_options(-fsanitize=address,undefined)
endif()
