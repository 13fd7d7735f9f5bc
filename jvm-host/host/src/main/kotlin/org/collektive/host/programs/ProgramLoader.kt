package org.collektive.host.programs

/** The class loader of one session's programs. Its [parent] is the library's loader, or the host's. */
public class ProgramLoader(jars: List<ProgramJar>, parent: ClassLoader = ProgramLoader::class.java.classLoader) :
    JarLoader(NAME, jars, parent) {
    public companion object {
        /** The loader's name; it marks the users' frames in stack traces. */
        internal const val NAME = "programs"

        init {
            registerAsParallelCapable()
        }
    }
}
