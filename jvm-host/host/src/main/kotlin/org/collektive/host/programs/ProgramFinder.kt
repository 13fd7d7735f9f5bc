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
 * Finds the functions annotated with [Program] in [jars]. It loads only classes that have some, and skips functions that are written
 * for another schema of [all].
 */
internal class ProgramFinder(
    private val jars: List<ProgramJar>,
    private val loader: ClassLoader,
    private val schema: DataSchema,
    all: List<DataSchema>,
) {
    private val otherSensors = all.map(DataSchema::sensorType) - schema.sensorType

    /** All programs by name, sorted by name. */
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
                        throw HostException(HostError.PROGRAM, "two programs are named '${info.name}': $other and $place; rename one")
                    }
                    programs[info.name] =
                        LoadedProgram(info, function(method, place), "${method.declaringClass.name}.${method.name}", loader)
                }
            }
        }
        return programs
    }

    private fun annotatedMethods(jar: ProgramJar, className: String): List<Method> = try {
        Class.forName(className, false, loader).declaredMethods.filter(::isWanted).sortedBy(Method::getName)
    } catch (e: LinkageError) {
        throw cannotLoad(jar, className, e)
    } catch (e: ClassNotFoundException) {
        throw cannotLoad(jar, className, e)
    }

    private fun isWanted(method: Method) =
        method.isAnnotationPresent(Program::class.java) && method.parameterTypes.getOrNull(1) !in otherSensors

    private fun cannotLoad(jar: ProgramJar, className: String, e: Throwable) =
        HostException(HostError.PROGRAM, "class $className of ${jar.path} cannot be loaded: $e; build the jar again", e)

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

        /** A name instead of a class, because the host does not depend on the DSL. */
        const val AGGREGATE = "it.unibo.collektive.aggregate.api.Aggregate"
        val ANNOTATION = Program::class.java.descriptorString().encodeToByteArray()

        fun contains(bytes: ByteArray, wanted: ByteArray): Boolean {
            val first = wanted[0]
            for (at in 0..bytes.size - wanted.size) {
                if (bytes[at] == first && bytes.regionMatches(at, wanted)) return true
            }
            return false
        }

        private fun ByteArray.regionMatches(at: Int, wanted: ByteArray): Boolean {
            for (index in wanted.indices) if (this[at + index] != wanted[index]) return false
            return true
        }
    }
}
