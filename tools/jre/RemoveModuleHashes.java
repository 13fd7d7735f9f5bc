import java.lang.classfile.ClassFile;
import java.lang.classfile.ClassTransform;
import java.lang.classfile.attribute.ModuleHashesAttribute;
import java.nio.file.Files;
import java.nio.file.Path;

/** {@code RemoveModuleHashes FOLDER...}: removes the hashes of linked modules, so that the modules in these folders can be linked into another image. */
class RemoveModuleHashes {
    public static void main(String[] folders) throws Exception {
        for (String folder : folders) {
            Path info = Path.of(folder, "module-info.class");
            ClassFile file = ClassFile.of();
            ClassTransform transform = ClassTransform.dropping(element -> element instanceof ModuleHashesAttribute);
            Files.write(info, file.transformClass(file.parse(info), transform));
        }
    }
}
