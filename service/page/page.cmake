# The viewer page: scripts bundled by esbuild, put with the style sheet into one HTML text, which becomes a source file of
# the server. Where esbuild or three.js is missing, the server sends its plain list of sessions instead.
set(page_in ${CMAKE_CURRENT_LIST_DIR})
# npm's, whose version is pinned, before Debian's; looked at in every configuration, since npm may have come or gone.
set(page_esbuild ${page_in}/node_modules/.bin/esbuild)
if(NOT EXISTS ${page_esbuild})
  find_program(GRIDCULL_ESBUILD esbuild)
  mark_as_advanced(GRIDCULL_ESBUILD)
  set(page_esbuild ${GRIDCULL_ESBUILD})
endif()
if(NOT page_esbuild OR NOT EXISTS ${page_in}/node_modules/three/package.json)
  message(STATUS "viewer page: a plain list of sessions (the page needs three.js and esbuild: run npm ci in service/page)")
  return()
endif()

set(page_out ${CMAKE_CURRENT_BINARY_DIR}/page)
file(MAKE_DIRECTORY ${page_out})
file(GLOB page_scripts CONFIGURE_DEPENDS ${page_in}/src/*.js)
add_custom_command(OUTPUT ${page_out}/page_text.cpp VERBATIM WORKING_DIRECTORY ${page_in}
  COMMENT "Bundling the viewer page"
  DEPENDS ${page_scripts} ${page_in}/index.html ${page_in}/style.css ${page_in}/package-lock.json ${page_in}/embed.cmake
  COMMAND ${page_esbuild} src/main.js --bundle --minify --format=iife --target=es2022 --legal-comments=inline
    --log-level=warning --outfile=${page_out}/page.js
  COMMAND ${page_esbuild} style.css --minify --log-level=warning --outfile=${page_out}/page.css
  COMMAND ${CMAKE_COMMAND} -DHTML=${page_in}/index.html -DOUT=${page_out} -P embed.cmake)
target_sources(gridcull_service PRIVATE ${page_out}/page_text.cpp)
target_compile_definitions(gridcull_service PRIVATE GRIDCULL_WITH_PAGE)
