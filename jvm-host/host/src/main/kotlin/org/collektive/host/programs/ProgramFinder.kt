package org.collektive.host.programs

import org.collektive.api.Device
import org.collektive.api.Metric
import org.collektive.api.NetworkSnapshot
import org.collektive.api.Program
import org.collektive.frames.data.DataSchema
import org.collektive.host.shim.HostError
import org.collektive.host.shim.HostException
import java.lang.invoke.MethodHandle
import java.lang.invoke.MethodHandles
import java.lang.reflect.Method
import java.lang.reflect.Modifier
import java.lang.reflect.ParameterizedType
import java.lang.reflect.Type

/** The programs and the metrics of jars by name, sorted by name. */
internal class UserFunctions(val programs: Map<String, LoadedProgram>, val metrics: Map<String, LoadedMetric>)

/**
 * Finds the functions annotated with [Program] or [Metric] in [jars]. Loads only classes with such functions, and skips functions for other
 * schemas of [all].
 */
internal class ProgramFinder(
    private val jars: List<ProgramJar>,
    private val loader: ClassLoader,
    private val schema: DataSchema,
    all: List<DataSchema>,
) {
    private val otherSensors = all.map(DataSchema::sensorType) - schema.sensorType

    /**
     * Returns all programs and metrics.
     *
     * @throws HostException when a class cannot be loaded, a function has another signature, or two programs or metrics have the same name.
     */
    fun find(): UserFunctions {
        val programs = sortedMapOf<String, LoadedProgram>()
        val metrics = sortedMapOf<String, LoadedMetric>()
        val places = HashMap<String, String>()
        for (jar in jars) {
            for ((entry, bytes) in jar.entries) {
                if (!entry.endsWith(CLASS) || ANNOTATIONS.none { contains(bytes, it) }) continue
                for (method in methods(jar, entry.removeSuffix(CLASS).replace('/', '.'))) {
                    val place = "${method.declaringClass.name}.${method.name} in ${jar.path}"
                    method.getAnnotation(Program::class.java)?.takeIf { method.parameterTypes.getOrNull(1) !in otherSensors }?.let {
                        places.putUnique("programs", it.name, place)
                        programs[it.name] =
                            LoadedProgram(it, function(method, place), "${method.declaringClass.name}.${method.name}", loader)
                    }
                    method.getAnnotation(Metric::class.java)?.takeIf { typesOf(method).firstOrNull() !in otherSensors }?.let {
                        places.putUnique("metrics", it.name, place)
                        metrics[it.name] = LoadedMetric(it.name, metric(method, place), loader)
                    }
                }
            }
        }
        return UserFunctions(programs, metrics)
    }

    private fun HashMap<String, String>.putUnique(kind: String, name: String, place: String) {
        val other = put("$kind $name", place) ?: return
        throw HostException(HostError.PROGRAM, "two $kind are named '$name': $other and $place; rename one of them")
    }

    private fun methods(jar: ProgramJar, className: String): List<Method> = try {
        Class.forName(className, false, loader).declaredMethods.sortedBy(Method::getName)
    } catch (e: LinkageError) {
        throw cannotLoad(jar, className, e)
    } catch (e: ClassNotFoundException) {
        throw cannotLoad(jar, className, e)
    }

    private fun cannotLoad(jar: ProgramJar, className: String, e: Throwable) =
        HostException(HostError.PROGRAM, "class $className of ${jar.path} cannot be loaded: $e; rebuild the jar", e)

    private fun function(method: Method, place: String): MethodHandle {
        val types = method.parameterTypes
        val takesDevice = types.size == 3
        val isProgram = isPublicFunction(method) && types.size in 2..3 && types[0].name == AGGREGATE && hasIntIds(method) &&
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

    private fun metric(method: Method, place: String): MethodHandle {
        val isMetric = isPublicFunction(method) && method.parameterTypes.singleOrNull() == NetworkSnapshot::class.java &&
            typesOf(method) == listOf(schema.sensorType, schema.actuatorType) && method.returnType == Double::class.javaPrimitiveType
        if (!isMetric) {
            val network = "NetworkSnapshot<${schema.sensorType.name}, ${schema.actuatorType.name}>"
            throw HostException(
                HostError.PROGRAM,
                "$place is not a metric of schema ${schema.name}: it must be a public top-level function " +
                    "${method.name}(network: $network): Double, but it is ${method.toGenericString()}",
            )
        }
        return MethodHandles.publicLookup().unreflect(method).asType(LoadedMetric.TYPE)
    }

    private fun isPublicFunction(method: Method) = Modifier.isPublic(method.modifiers) && Modifier.isStatic(method.modifiers) &&
        Modifier.isPublic(method.declaringClass.modifiers)

    /** Returns the type arguments of the first parameter. */
    private fun typesOf(method: Method): List<Type> =
        (method.genericParameterTypes.firstOrNull() as? ParameterizedType)?.actualTypeArguments.orEmpty().toList()

    private fun hasIntIds(method: Method): Boolean {
        val aggregate = method.genericParameterTypes.first() as? ParameterizedType ?: return false
        return aggregate.actualTypeArguments.single() == Int::class.javaObjectType
    }

    private companion object {
        const val CLASS = ".class"

        /** The name of the class, because the host does not depend on the DSL. */
        const val AGGREGATE = "it.unibo.collektive.aggregate.api.Aggregate"
        val ANNOTATIONS = listOf(Program::class, Metric::class).map { it.java.descriptorString().encodeToByteArray() }

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
