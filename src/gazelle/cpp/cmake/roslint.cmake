# Checks of the real build tools: nothing is done here.

function(roslint_cpp)
endfunction()
function(roslint_python)
endfunction()
function(roslint_custom)
endfunction()
function(roslint_add_test)
endfunction()
