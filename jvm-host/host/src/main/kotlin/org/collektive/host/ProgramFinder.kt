package org.collektive.host

import it.unibo.collektive.aggregate.api.Aggregate
import org.collektive.api.Device
import org.collektive.api.Program
import org.collektive.api.schema.DataSchema
import java.lang.invoke.LambdaMetafactory
import java.lang.invoke.MethodHandle
import java.lang.invoke.MethodHandles
import java.lang.invoke.MethodType
import java.lang.reflect.Method
import java.lang.reflect.Modifier
import java.lang.reflect.ParameterizedType

/** Finds the functions annotated with [Program] in [jars], and loads no class without one. */
internal class ProgramFinder(private val jars: List<ProgramJar>, private val loader: ClassLoader, private val schema: DataSchema) {
    /** All programs by name, in the order of the names. */
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
                    programs[info.name] = LoadedProgram(info, body(method, place))
                }
            }
        }
        return programs
    }

    private fun annotatedMethods(jar: ProgramJar, className: String): List<Method> = try {
        Class.forName(className, false, loader).declaredMethods.filter { it.isAnnotationPresent(Program::class.java) }.sortedBy(Method::getName)
    } catch (e: LinkageError) {
        throw cannotLoad(jar, className, e)
    } catch (e: ClassNotFoundException) {
        throw cannotLoad(jar, className, e)
    }

    private fun cannotLoad(jar: ProgramJar, className: String, e: Throwable) =
        HostException(HostError.PROGRAM, "class $className of ${jar.path} cannot be loaded: $e; build the jar again", e)

    private fun body(method: Method, place: String): ProgramBody {
        val types = method.parameterTypes
        val takesDevice = types.size == 3
        val isProgram = Modifier.isPublic(method.modifiers) && Modifier.isStatic(method.modifiers) &&
            Modifier.isPublic(method.declaringClass.modifiers) &&
            types.size in 2..3 && types[0] == Aggregate::class.java && hasIntIds(method) &&
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
        val lookup = MethodHandles.privateLookupIn(method.declaringClass, MethodHandles.lookup())
        val handle = lookup.unreflect(method)
        if (takesDevice) return lambda(lookup, handle, ProgramBody::class.java, DEVICE_TYPE) as ProgramBody
        val plain = lambda(lookup, handle, PlainProgramBody::class.java, PLAIN_TYPE) as PlainProgramBody
        return ProgramBody { aggregate, sensors, _ -> plain.run(aggregate, sensors) }
    }

    private fun hasIntIds(method: Method): Boolean {
        val aggregate = method.genericParameterTypes.first() as? ParameterizedType ?: return false
        return aggregate.actualTypeArguments.single() == Int::class.javaObjectType
    }

    /** Calls through an object of [type] cost no more than calls in Java source, and allocate nothing. */
    private fun lambda(lookup: MethodHandles.Lookup, handle: MethodHandle, type: Class<*>, erased: MethodType): Any =
        LambdaMetafactory.metafactory(lookup, "run", MethodType.methodType(type), erased, handle, handle.type()).target.invoke()

    private companion object {
        const val CLASS = ".class"
        val ANNOTATION = Program::class.java.descriptorString().encodeToByteArray()
        val PLAIN_TYPE: MethodType = MethodType.methodType(Any::class.java, Aggregate::class.java, Any::class.java)
        val DEVICE_TYPE: MethodType = PLAIN_TYPE.appendParameterTypes(Device::class.java)

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
