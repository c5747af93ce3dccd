# cmake -D program=FILE -D tree=FOLDER -P no_path.cmake: no path of the tree stands in the program, so that builds in two folders can be the
# same bytes.
file(STRINGS ${program} found REGEX "${tree}/" LIMIT_COUNT 3)
if(found)
  message(FATAL_ERROR "${program} holds the path of its tree: ${found}")
endif()
