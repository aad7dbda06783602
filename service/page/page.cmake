# The viewer page: scripts bundled by esbuild, put with the style sheet into one HTML text, which becomes a source file of
# the server. Where esbuild or three.js is missing, the server sends its plain list of sessions instead.
set(page_in ${CMAKE_CURRENT_LIST_DIR})
find_program(GRIDCULL_ESBUILD esbuild PATHS ${page_in}/node_modules/.bin NO_DEFAULT_PATH)
find_program(GRIDCULL_ESBUILD esbuild)
mark_as_advanced(GRIDCULL_ESBUILD)
# Looked at in every configuration: npm may have come or gone since the last one.
if(GRIDCULL_ESBUILD AND NOT EXISTS ${GRIDCULL_ESBUILD})
  unset(GRIDCULL_ESBUILD CACHE)
  find_program(GRIDCULL_ESBUILD esbuild)
endif()
if(NOT GRIDCULL_ESBUILD OR NOT EXISTS ${page_in}/node_modules/three/package.json)
  message(STATUS "viewer page: a plain list of sessions (the page needs three.js and esbuild: run npm ci in service/page)")
  return()
endif()

set(page_out ${CMAKE_CURRENT_BINARY_DIR}/page)
file(MAKE_DIRECTORY ${page_out})
file(GLOB page_scripts CONFIGURE_DEPENDS ${page_in}/src/*.js)
add_custom_command(OUTPUT ${page_out}/page_text.cpp VERBATIM WORKING_DIRECTORY ${page_in}
  COMMENT "Bundling the viewer page"
  DEPENDS ${page_scripts} ${page_in}/index.html ${page_in}/style.css ${page_in}/package-lock.json ${page_in}/embed.cmake
  COMMAND ${GRIDCULL_ESBUILD} src/main.js --bundle --minify --format=iife --target=es2022 --legal-comments=inline
    --log-level=warning --outfile=${page_out}/page.js
  COMMAND ${GRIDCULL_ESBUILD} style.css --minify --log-level=warning --outfile=${page_out}/page.css
  COMMAND ${CMAKE_COMMAND} -DHTML=${page_in}/index.html -DOUT=${page_out} -P embed.cmake)
target_sources(gridcull_service PRIVATE ${page_out}/page_text.cpp)
target_compile_definitions(gridcull_service PRIVATE GRIDCULL_WITH_PAGE)
