package org.collektive.host.programs

/** The class loader of one session's programs. Its [parent] is the class loader of the library or the host. */
public class ProgramLoader(jars: List<ProgramJar>, parent: ClassLoader = ProgramLoader::class.java.classLoader) :
    JarLoader(NAME, jars, parent) {
    public companion object {
        /** The name of the loader, which identifies user code in stack traces. */
        internal const val NAME = "programs"

        init {
            registerAsParallelCapable()
        }
    }
}
