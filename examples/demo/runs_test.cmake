# The main job on a small vessel: exit code 0, its own proof, its files, and the same bits for all numbers of THREADS, the first of
# which is 1.
set(files demo.vtu contacts.vtu wall.vtu outer.vtu catheter_static.vtu catheter_adaptive.vtu catheter_slide.vtu
    catheter_adaptive_contacts.vtu surface.vtu obstacles.vtu
    tissue.vtu scalpel.vtu probe.vtu beating.vtu catheter_beaten.vtu box.vtu ring_one.vtu ring_two.vtu)
foreach(threads IN LISTS THREADS)
  set(out ${OUT}/${threads})
  file(REMOVE_RECURSE ${out})
  file(MAKE_DIRECTORY ${out})
  execute_process(COMMAND ${DEMO} --spacing 2.5 --particles 1000 --steps 40 --fall-steps 3 --cut-steps 4 --box-steps 12
      --threads ${threads} --out ${out}
    RESULT_VARIABLE code OUTPUT_VARIABLE table ERROR_VARIABLE message)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "exit code ${code}: ${message}${table}")
  endif()
  if(NOT table MATCHES "verified free +yes" OR NOT table MATCHES "\n  contacts +[1-9]")
    message(FATAL_ERROR "not proven, or nothing was met: ${table}")
  endif()
  if(NOT table MATCHES "\n  bodies verified free +yes +yes +yes +yes" OR
     NOT table MATCHES "\n  contacts of bodies +[1-9]")
    message(FATAL_ERROR "bodies not proven, or nothing was met: ${table}")
  endif()
  if(NOT table MATCHES "\n  free after every step +yes +yes +yes" OR NOT table MATCHES "\n  all volumes valid +yes +yes +yes" OR
     NOT table MATCHES "\n  contacts of walls +0 +[1-9]" OR NOT table MATCHES "\n  of these with bodies +0 +0 +[1-9]" OR
     NOT table MATCHES "the probe touches at 0\\.[1-9]")
    message(FATAL_ERROR "a scene that changes is not proven, or nothing was met: ${table}")
  endif()
  foreach(file IN LISTS files)
    file(SIZE ${out}/${file} size)
    if(size LESS 1000)
      message(FATAL_ERROR "${file} has only ${size} bytes")
    endif()
    file(SHA256 ${out}/${file} sum_${threads}_${file})
    if(NOT sum_${threads}_${file} STREQUAL sum_1_${file})
      message(FATAL_ERROR "${file} differs between 1 and ${threads} threads")
    endif()
  endforeach()
endforeach()
