package org.collektive.host.programs

import org.collektive.api.Device
import org.collektive.api.Program
import org.collektive.frames.data.DataSchema
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.lang.invoke.MethodHandle
import java.lang.invoke.MethodHandles
import java.lang.reflect.Method
import java.lang.reflect.Modifier
import java.lang.reflect.ParameterizedType

/**
 * Finds the functions annotated with [Program] in [jars]. Loads only classes with such functions, and skips functions for other schemas
 * of [all].
 */
internal class ProgramFinder(
    private val jars: List<ProgramJar>,
    private val loader: ClassLoader,
    private val schema: DataSchema,
    all: List<DataSchema>,
) {
    private val otherSensors = all.map(DataSchema::sensorType) - schema.sensorType

    /**
     * Returns all programs by name, sorted by name.
     *
     * @throws HostException when a class cannot be loaded, a function has another signature, or two programs have the same name.
     */
    fun find(): Map<String, LoadedProgram> {
        val programs = sortedMapOf<String, LoadedProgram>()
        val places = HashMap<String, String>()
        for (jar in jars) {
            for ((entry, bytes) in jar.entries) {
                if (!entry.endsWith(CLASS) || !contains(bytes, ANNOTATION)) continue
                for (method in annotatedMethods(jar, entry.removeSuffix(CLASS).replace('/', '.'))) {
                    val info = method.getAnnotation(Program::class.java)
                    val place = "${method.declaringClass.name}.${method.name} in ${jar.path}"
                    val other = places.put(info.name, place)
                    if (other != null) {
                        throw HostException(
                            HostError.PROGRAM,
                            "two programs are named '${info.name}': $other and $place; rename one of them",
                        )
                    }
                    programs[info.name] =
                        LoadedProgram(info, function(method, place), "${method.declaringClass.name}.${method.name}", loader)
                }
            }
        }
        return programs
    }

    private fun annotatedMethods(jar: ProgramJar, className: String): List<Method> = try {
        Class.forName(className, false, loader).declaredMethods.filter(::isForSchema).sortedBy(Method::getName)
    } catch (e: LinkageError) {
        throw cannotLoad(jar, className, e)
    } catch (e: ClassNotFoundException) {
        throw cannotLoad(jar, className, e)
    }

    private fun isForSchema(method: Method) =
        method.isAnnotationPresent(Program::class.java) && method.parameterTypes.getOrNull(1) !in otherSensors

    private fun cannotLoad(jar: ProgramJar, className: String, e: Throwable) =
        HostException(HostError.PROGRAM, "class $className of ${jar.path} cannot be loaded: $e; rebuild the jar", e)

    private fun function(method: Method, place: String): MethodHandle {
        val types = method.parameterTypes
        val takesDevice = types.size == 3
        val isProgram = Modifier.isPublic(method.modifiers) && Modifier.isStatic(method.modifiers) &&
            Modifier.isPublic(method.declaringClass.modifiers) &&
            types.size in 2..3 && types[0].name == AGGREGATE && hasIntIds(method) &&
            types[1] == schema.sensorType && (!takesDevice || types[2] == Device::class.java) &&
            schema.actuatorType.isAssignableFrom(method.returnType)
        if (!isProgram) {
            val sensors = schema.sensorType.name
            val actuators = schema.actuatorType.name
            throw HostException(
                HostError.PROGRAM,
                "$place is not a program of schema ${schema.name}: it must be a public top-level function " +
                    "Aggregate<Int>.${method.name}(sensors: $sensors): $actuators, where 'device: ${Device::class.java.name}' may " +
                    "follow the sensors, but it is ${method.toGenericString()}",
            )
        }
        val handle = MethodHandles.publicLookup().unreflect(method)
        val full = if (takesDevice) handle else MethodHandles.dropArguments(handle, types.size, Device::class.java)
        return full.asType(LoadedProgram.TYPE)
    }

    private fun hasIntIds(method: Method): Boolean {
        val aggregate = method.genericParameterTypes.first() as? ParameterizedType ?: return false
        return aggregate.actualTypeArguments.single() == Int::class.javaObjectType
    }

    private companion object {
        const val CLASS = ".class"

        /** The name of the class, because the host does not depend on the DSL. */
        const val AGGREGATE = "it.unibo.collektive.aggregate.api.Aggregate"
        val ANNOTATION = Program::class.java.descriptorString().encodeToByteArray()

        fun contains(bytes: ByteArray, pattern: ByteArray): Boolean {
            val first = pattern[0]
            for (at in 0..bytes.size - pattern.size) {
                if (bytes[at] == first && bytes.regionMatches(at, pattern)) return true
            }
            return false
        }

        private fun ByteArray.regionMatches(at: Int, pattern: ByteArray): Boolean {
            for (index in pattern.indices) if (this[at + index] != pattern[index]) return false
            return true
        }
    }
}
