import java.nio.file.Path;
import java.util.TreeMap;
import org.jetbrains.kotlin.buildtools.api.KotlinToolchains;
import org.jetbrains.kotlin.buildtools.api.jvm.AccessibleClassSnapshot;
import org.jetbrains.kotlin.buildtools.api.jvm.ClassSnapshotGranularity;
import org.jetbrains.kotlin.buildtools.api.jvm.JvmPlatformToolchain;
import org.jetbrains.kotlin.buildtools.api.jvm.operations.JvmClasspathSnapshottingOperation;

/** Prints the classes of each folder that other modules can see, with a hash of their visible parts by Kotlin's build tools. */
class Abi {
    public static void main(String[] folders) {
        KotlinToolchains toolchains = KotlinToolchains.loadImplementation(Abi.class.getClassLoader());
        try (KotlinToolchains.BuildSession session = toolchains.createBuildSession()) {
            for (String folder : folders) {
                var operation = JvmPlatformToolchain.from(toolchains).classpathSnapshottingOperationBuilder(Path.of(folder));
                operation.set(JvmClasspathSnapshottingOperation.GRANULARITY, ClassSnapshotGranularity.CLASS_LEVEL);
                // The compiler copies bodies of inline functions and their lambdas into callers, so they are part of the ABI.
                operation.set(JvmClasspathSnapshottingOperation.PARSE_INLINED_LOCAL_CLASSES, true);
                System.out.println(folder);
                new TreeMap<>(session.executeOperation(operation.build()).getClassSnapshots()).forEach((name, snapshot) -> {
                    if (snapshot instanceof AccessibleClassSnapshot accessible) {
                        System.out.println("  " + name + " " + accessible.getClassAbiHash());
                    }
                });
            }
        }
    }
}
