# Plug-in libraries are found by the host of nodes; nothing has to be hidden for it.

function(class_loader_hide_library_symbols target)
endfunction()
