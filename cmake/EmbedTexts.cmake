# skylapse_add_text(texts name file): appends the row {"name", text of the file} to the variable `texts`, for
# a table of std::string_view in a configured source; the file's changes configure again.
function(skylapse_add_text variable name file)
  file(READ ${file} text)
  # A compiler takes at least 64 KiB of one literal: longer texts are several, side by side.
  string(LENGTH "${text}" length)
  set(literals "")
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} 15000 part)
    string(APPEND literals "R\"text(${part})text\"\n")
    math(EXPR begin "${begin} + 15000")
  endwhile()
  set(${variable} "${${variable}}    {\"${name}\", ${literals}},\n" PARENT_SCOPE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endfunction()
